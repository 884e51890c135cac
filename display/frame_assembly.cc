// Images, swaps and nodes as they come.
#include "display/frame_assembly.h"

#include <algorithm>

#include "base/log.h"
#include "proto/images/image_payload.h"

namespace lfd::display {

void FrameAssembly::configure(int modules, ImageSize image, std::span<const std::uint32_t> owned,
                              std::size_t waiting_bytes) {
  image_ = image;
  limits_ = {waiting_bytes, std::max<std::size_t>(std::size_t{16} * image.width * image.height, 1),
             static_cast<std::uint32_t>(modules)};
  owned_.assign(modules, owned.empty());
  for (const std::uint32_t module : owned) {
    if (module < owned_.size()) owned_[module] = true;
  }
  owner_.assign(modules, "");
  shown_.assign(modules, {});
  last_shown_.reset();
  latest_swapped_.reset();
  latest_swap_ = {};
  for (const auto& [frame, pending] : pending_) {
    for (const auto& [name, from] : pending.nodes) release(name, from);
  }
  pending_.clear();
  std::erase_if(nodes_, [](const auto& entry) { return !entry.second.is_here; });
  for (auto& [name, node] : nodes_) {
    node.latest_frame = 0;
    node.held.clear();
  }
}

Status FrameAssembly::node_came(const std::string& name, Clock::time_point now) {
  if (!nodes_.contains(name) && nodes_.size() >= kMaxNodes)
    return Error(fmt::format("more than {} nodes have come", kMaxNodes));
  // What is not whole is going to be sent again from its beginning.
  for (auto& [frame, pending] : pending_) {
    const auto from = pending.nodes.find(name);
    if (from == pending.nodes.end() || from->second.is_whole()) continue;
    release(name, from->second);
    pending.nodes.erase(from);
  }
  Node& node = nodes_[name];
  node.is_here = true;
  node.has_lost_touch = false;
  node.credit.start();
  node.latest_frame = 0;
  node.connection = ++events_;
  node.last_sign = now;
  node.held.clear();
  return {};
}

void FrameAssembly::node_left(const std::string& name, Clock::time_point now) {
  const auto node = nodes_.find(name);
  if (node == nodes_.end()) return;
  node->second.is_here = false;
  node->second.last_sign = now;
  node->second.held.clear();
}

bool FrameAssembly::is_past(std::uint64_t frame) const {
  if (last_shown_ && frame <= *last_shown_) return true;
  // A swap makes a place for its frame; where there is none any more, the frame has been given up.
  return latest_swapped_ && frame <= *latest_swapped_ && !pending_.contains(frame);
}

// What must hold of an image whatever its payload is.
Status FrameAssembly::check(const proto::Image& what) const {
  if (what.module() >= shown_.size()) return Error(fmt::format("the display has {} modules", shown_.size()));
  if (!proto::BufferKind_IsValid(what.buffer()) || !proto::PixelFormat_IsValid(what.format()) ||
      !proto::Encoding_IsValid(what.encoding())) {
    return Error("its buffer, format or encoding is unknown");
  }
  if ((what.buffer() == proto::COLOR) != (what.format() == proto::RGBA8))
    return Error("its format is not that of its buffer");
  if (what.of_images() < 1 || what.of_images() > shown_.size() * kBufferKinds)
    return Error(fmt::format("it is one of {}", what.of_images()));
  if (what.empty()) return {};
  const ImageSize size{static_cast<int>(what.width_px()), static_cast<int>(what.height_px())};
  if (size == image_) return {};
  return Error(fmt::format("{} x {} pixels; the display's modules have {} x {}", what.width_px(), what.height_px(),
                           image_.width, image_.height));
}

// The image with its payload, which is kept for those that say that they are the same.
Result<std::shared_ptr<const ReceivedImage>> FrameAssembly::received(Node& node, const proto::Image& what,
                                                                     wire::Payload&& payload) const {
  if ((what.empty() || what.has_same_as_frame()) && !payload.empty())
    return Error(what.empty() ? "it is empty, yet has pixels" : "it is the same as before, yet has pixels");
  if (what.empty()) return std::make_shared<const ReceivedImage>(ReceivedImage{what, {}});
  auto& held = node.held[{what.module(), what.buffer()}];
  if (what.has_same_as_frame()) {
    if (held != nullptr && held->what.frame() == what.same_as_frame() && held->what.encoding() == what.encoding())
      return std::make_shared<const ReceivedImage>(ReceivedImage{what, held->payload});
    node.has_lost_touch = true;
    return Error(fmt::format("that of frame {}, as which it is the same, is not here", what.same_as_frame()));
  }
  LFD_TRY_STATUS(check_payload(what, payload));
  held = std::make_shared<const ReceivedImage>(ReceivedImage{what, std::move(payload)});
  return held;
}

Status FrameAssembly::image_came(const std::string& name, const proto::Image& what, wire::Payload payload,
                                 Clock::time_point now) {
  const auto within = [&](const Error& error) {
    return error.within(fmt::format("image of frame {}, module {}, buffer {}", what.frame(), what.module(),
                                    static_cast<int>(what.buffer())));
  };
  const auto found = nodes_.find(name);
  if (found == nodes_.end() || !found->second.is_here) return within(Error("its sender has not said hello"));
  Node& node = found->second;
  node.last_sign = now;
  if (!node.credit.use()) {
    node.has_lost_touch = true;
    return within(Error("it came without credit"));
  }
  if (const Status status = check(what); !status) return within(status.error());
  auto image = received(node, what, std::move(payload));
  if (!image) return within(image.error());
  node.latest_frame = std::max(node.latest_frame, what.frame());
  const Status placed = place(name, node, *std::move(image), now);
  return placed ? placed : within(placed.error());
}

// Puts an image where it waits for its frame.
Status FrameAssembly::place(const std::string& name, Node& node, std::shared_ptr<const ReceivedImage> image,
                            Clock::time_point now) {
  const proto::Image& what = image->what;
  if (last_shown_ && what.frame() <= *last_shown_) return Error(fmt::format("frame {} is past", *last_shown_));
  if (is_past(what.frame())) return Error("its frame was dropped");
  const std::size_t bytes = image->payload.size();
  if (!node.credit.fits(limits_, bytes, what.of_images())) return Error("too much of its node waits already");
  if (!pending_.contains(what.frame()) && pending_.size() >= kMaxFrames) {
    if (what.frame() < pending_.begin()->first) return Error("too many later frames wait");
    drop(pending_.begin());
  }
  Pending& pending = pending_[what.frame()];
  FromNode& from = pending.nodes[name];
  ShownModule& module = from.modules[what.module()];
  auto& at = module.image[what.buffer()];
  if (at != nullptr) return from.connection == node.connection ? Error("it has come before") : Status();
  module.frame = what.frame();
  node.credit.waits(bytes, what.empty() ? 1 : pixel_bytes(what), what.of_images());
  at = std::move(image);
  ++from.here;
  from.bytes += bytes;
  from.expected = what.of_images();
  from.connection = node.connection;
  pending.latest_arrival = now;
  owner_[what.module()] = name;
  return {};
}

void FrameAssembly::image_passed_over(const std::string& name) {
  const auto node = nodes_.find(name);
  if (node != nodes_.end()) node->second.credit.use();
}

void FrameAssembly::swapped(std::uint64_t frame, std::span<const std::uint32_t> stale_modules, const Owners& owners) {
  if (shown_.empty() || (last_shown_ && frame <= *last_shown_)) return;
  Swap swap{{stale_modules.begin(), stale_modules.end()}, owners, ++events_};
  if (!latest_swapped_ || frame > *latest_swapped_) {
    latest_swapped_ = frame;
    latest_swap_ = swap;
  }
  // Swaps come in order: those of earlier frames that did not come are lost, and nothing says that they named stale
  // modules.
  for (auto& [number, pending] : pending_) {
    if (number < frame && !pending.swap) pending.swap = Swap{{}, {}, events_};
  }
  if (!pending_.contains(frame) && pending_.size() >= kMaxFrames) {
    if (frame < pending_.begin()->first) return;
    drop(pending_.begin());
  }
  std::optional<Swap>& known = pending_[frame].swap;
  if (known) swap.event = known->event;  // it is said again: what has come since has come since
  known = std::move(swap);
}

std::uint32_t FrameAssembly::credit_for(const std::string& name) {
  const auto node = nodes_.find(name);
  if (node == nodes_.end() || !node->second.is_here || shown_.empty()) return 0;
  return node->second.credit.give(limits_);
}

bool FrameAssembly::has_lost_touch(const std::string& name) const {
  const auto node = nodes_.find(name);
  return node != nodes_.end() && node->second.has_lost_touch;
}

std::size_t FrameAssembly::waiting_images() const {
  std::size_t count = 0;
  for (const auto& [frame, pending] : pending_) {
    for (const auto& [name, from] : pending.nodes) count += from.here;
  }
  return count;
}

std::size_t FrameAssembly::waiting_bytes() const {
  std::size_t bytes = 0;
  for (const auto& [frame, pending] : pending_) {
    for (const auto& [name, from] : pending.nodes) bytes += from.bytes;
  }
  return bytes;
}

}  // namespace lfd::display
