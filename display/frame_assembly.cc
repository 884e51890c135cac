// Frames waiting for their images, and the credits that bound them.
#include "display/frame_assembly.h"

#include <algorithm>

#include "base/log.h"

namespace lfd::display {
namespace {

std::size_t bytes_of(const proto::Image& what) {
  const std::size_t pixels = std::size_t{what.width_px()} * what.height_px();
  return pixels * (what.format() == proto::RGBA8 ? 4 : 16);
}

}  // namespace

void FrameAssembly::configure(int modules, ImageSize image, std::span<const std::uint32_t> owned) {
  image_ = image;
  owned_.assign(modules, owned.empty());
  for (const std::uint32_t module : owned) {
    if (module < owned_.size()) owned_[module] = true;
  }
  owner_.assign(modules, "");
  shown_.assign(modules, {});
  last_shown_.reset();
  latest_swap_.reset();
  pending_.clear();
  for (auto& [name, node] : nodes_) {
    node.waiting = 0;
    node.allowed = first_allowance();
    node.latest_frame = 0;
  }
}

std::uint32_t FrameAssembly::first_allowance() const {
  const std::size_t largest = std::size_t{16} * image_.width * image_.height;
  const std::size_t fit = kWaitingPerNode_bytes / std::max<std::size_t>(largest, 1);
  return static_cast<std::uint32_t>(std::clamp<std::size_t>(fit, 1, std::max<std::size_t>(shown_.size(), 1)));
}

void FrameAssembly::node_came(const std::string& node) {
  nodes_.try_emplace(node).first->second.allowed = first_allowance();
}

void FrameAssembly::node_left(const std::string& node) { nodes_.erase(node); }

Status FrameAssembly::check(const Node& node, const proto::Image& what, std::size_t payload_bytes) const {
  if (node.credit == 0) return Error("it came without credit");
  if (what.module() >= shown_.size()) return Error(fmt::format("the display has {} modules", shown_.size()));
  if (!proto::BufferKind_IsValid(what.buffer()) || !proto::PixelFormat_IsValid(what.format()) ||
      what.encoding() != proto::RAW) {
    return Error("its buffer, format or encoding is unknown");
  }
  if ((what.buffer() == proto::COLOR) != (what.format() == proto::RGBA8))
    return Error("its format is not that of its buffer");
  if (what.of_images() < 1 || what.of_images() > kMaxImagesPerFrame)
    return Error(fmt::format("it is one of {}", what.of_images()));
  if (is_past(what.frame())) return Error(fmt::format("frame {} is past", *last_shown_));
  // A swap makes a place for its frame; where there is none any more, the frame has been given up.
  if (latest_swap_ && what.frame() <= *latest_swap_ && !pending_.contains(what.frame()))
    return Error("its frame was dropped");
  if (what.empty()) return payload_bytes == 0 ? Status() : Status(Error("it is empty, yet has pixels"));
  const ImageSize size{static_cast<int>(what.width_px()), static_cast<int>(what.height_px())};
  if (size != image_) {
    return Error(fmt::format("{} x {} pixels; the display's modules have {} x {}", size.width, size.height,
                             image_.width, image_.height));
  }
  if (payload_bytes != bytes_of(what))
    return Error(fmt::format("{} bytes; {} make its pixels", payload_bytes, bytes_of(what)));
  return {};
}

Status FrameAssembly::image_came(const std::string& name, const proto::Image& what, wire::Payload pixels,
                                 Clock::time_point now) {
  const auto within = [&](const Error& error) {
    return error.within(fmt::format("image of frame {}, module {}, buffer {}", what.frame(), what.module(),
                                    static_cast<int>(what.buffer())));
  };
  const auto found = nodes_.find(name);
  if (found == nodes_.end()) return within(Error("its sender has not said hello"));
  Node& node = found->second;
  const Status status = check(node, what, pixels.size());
  if (node.credit > 0) --node.credit;
  if (!status) return within(status.error());
  if (!pending_.contains(what.frame()) && pending_.size() >= kMaxFrames) {
    if (what.frame() < pending_.begin()->first) return within(Error("too many later frames wait"));
    drop(pending_.begin());
  }
  Pending& pending = pending_[what.frame()];
  Module& module = pending.modules[what.module()];
  if (!module.node.empty() && module.node != name) return within(Error("another node has sent this module"));
  auto& place = module.images.image[what.buffer()];
  if (place != nullptr) return within(Error("it has come before"));
  module.node = name;
  module.images.frame = what.frame();
  const std::size_t bytes = std::max<std::size_t>(pixels.size(), 1);
  place = std::make_shared<const ReceivedImage>(ReceivedImage{what, std::move(pixels)});
  FromNode& from = pending.nodes[name];
  ++from.here;
  from.expected = what.of_images();
  pending.latest_arrival = now;
  owner_[what.module()] = name;
  node.latest_frame = std::max(node.latest_frame, what.frame());
  ++node.waiting;
  const std::size_t fit =
      std::min<std::size_t>(kWaitingPerNode_bytes / bytes, std::size_t{kFramesPerNode} * what.of_images());
  node.allowed = std::max(what.of_images(), static_cast<std::uint32_t>(fit));
  return {};
}

void FrameAssembly::swapped(std::uint64_t frame, std::span<const std::uint32_t> stale_modules) {
  if (shown_.empty() || (last_shown_ && frame <= *last_shown_)) return;
  latest_swap_ = std::max(latest_swap_.value_or(frame), frame);
  // Swaps come in order: those of earlier frames that did not come are lost, and nothing says that they named stale
  // modules.
  for (auto& [number, pending] : pending_) {
    if (number < frame && !pending.stale) pending.stale.emplace();
  }
  if (!pending_.contains(frame) && pending_.size() >= kMaxFrames) {
    if (frame < pending_.begin()->first) return;
    drop(pending_.begin());
  }
  pending_[frame].stale.emplace(stale_modules.begin(), stale_modules.end());
}

FrameAssembly::Fate FrameAssembly::fate(std::uint64_t frame, const Pending& pending,
                                        const std::set<std::uint32_t>& stale) const {
  Fate fate = Fate::kWhole;
  for (std::uint32_t module = 0; module < shown_.size(); ++module) {
    if (!owned_[module] || stale.contains(module)) continue;
    const auto sent = pending.modules.find(module);
    const std::string& owner = sent != pending.modules.end() ? sent->second.node : owner_[module];
    const auto from = pending.nodes.find(owner);
    if (from != pending.nodes.end() && from->second.here >= from->second.expected) continue;
    // Nodes send frame after frame: one that has begun a later frame, or has left, will not complete this one.
    const auto node = nodes_.find(owner);
    const bool past = node == nodes_.end() ? !owner.empty() : node->second.latest_frame > frame;
    if (past) return Fate::kHopeless;
    fate = Fate::kWaits;
  }
  return fate;
}

std::optional<ShownFrame> FrameAssembly::next_frame(Clock::time_point now) {
  for (auto at = pending_.begin(); at != pending_.end();) {
    const auto here = at++;
    auto& [frame, pending] = *here;
    const bool patience_is_over = pending.latest_arrival && now - *pending.latest_arrival >= kSwapPatience;
    if (!pending.stale && !patience_is_over) continue;
    switch (fate(frame, pending, pending.stale.value_or(std::set<std::uint32_t>()))) {
      case Fate::kWaits:
        continue;
      case Fate::kHopeless:
        // Without its swap it may still come to be shown with modules marked stale.
        if (pending.stale) drop(here);
        continue;
      case Fate::kWhole:
        break;
    }
    const std::uint64_t number = frame;
    while (pending_.begin()->first < number) drop(pending_.begin());
    auto whole = pending_.extract(here);
    release(whole.mapped());
    return show(number, std::move(whole.mapped()));
  }
  return std::nullopt;
}

ShownFrame FrameAssembly::show(std::uint64_t frame, Pending&& pending) {
  ShownFrame result{frame, {}, 0};
  for (std::uint32_t module = 0; module < shown_.size(); ++module) {
    const bool stale = !owned_[module] || (pending.stale && pending.stale->contains(module));
    const auto sent = pending.modules.find(module);
    if (!stale && sent != pending.modules.end()) shown_[module] = std::move(sent->second.images);
    shown_[module].stale = stale;
    if (!stale) ++result.fresh_modules;
  }
  last_shown_ = frame;
  result.modules = shown_;
  return result;
}

void FrameAssembly::drop(std::map<std::uint64_t, Pending>::iterator pending) {
  release(pending->second);
  pending_.erase(pending);
  ++dropped_frames_;
}

void FrameAssembly::release(const Pending& pending) {
  for (const auto& [name, from] : pending.nodes) {
    const auto node = nodes_.find(name);
    if (node != nodes_.end()) node->second.waiting -= std::min(node->second.waiting, from.here);
  }
}

std::uint32_t FrameAssembly::credit_for(const std::string& name) {
  const auto found = nodes_.find(name);
  if (found == nodes_.end() || shown_.empty()) return 0;
  Node& node = found->second;
  const std::uint32_t used = node.credit + node.waiting;
  const std::uint32_t more = node.allowed > used ? node.allowed - used : 0;
  node.credit += more;
  return more;
}

std::size_t FrameAssembly::waiting_images() const {
  std::size_t count = 0;
  for (const auto& [frame, pending] : pending_) {
    for (const auto& [name, from] : pending.nodes) count += from.here;
  }
  return count;
}

}  // namespace lfd::display
