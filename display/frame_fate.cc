// Which frames are shown, which are waited for, and which are given up.
#include <algorithm>

#include "display/frame_assembly.h"

namespace lfd::display {

bool FrameAssembly::is_waited_for(std::uint32_t module, const std::optional<Swap>& swap) const {
  if (!owned_[module]) return false;
  if (!swap) return true;
  return !swap->stale.contains(module) && (swap->owners.empty() || swap->owners.contains(module));
}

// The node whose image of the module the frame shows; empty: nobody has ever sent one.
const std::string& FrameAssembly::owner_of(std::uint32_t module, const Pending& pending) const {
  if (pending.swap) {
    const auto named = pending.swap->owners.find(module);
    if (named != pending.swap->owners.end()) return named->second;
  }
  const auto has_it = [&](const auto& entry) { return entry.second.modules.contains(module); };
  const auto last = pending.nodes.find(owner_[module]);
  if (last != pending.nodes.end() && has_it(*last)) return last->first;
  const auto any = std::ranges::find_if(pending.nodes, has_it);
  return any == pending.nodes.end() ? owner_[module] : any->first;
}

FrameAssembly::Fate FrameAssembly::fate(std::uint64_t frame, const Pending& pending, Clock::time_point now) const {
  Fate fate = Fate::kWhole;
  for (std::uint32_t module = 0; module < shown_.size(); ++module) {
    if (!is_waited_for(module, pending.swap)) continue;
    const auto from = pending.nodes.find(owner_of(module, pending));
    const bool is_whole = from != pending.nodes.end() && from->second.is_whole();
    if (is_whole && from->second.modules.contains(module)) continue;
    if (is_whole && pending.swap && pending.swap->owners.contains(module)) return Fate::kHopeless;  // it lacks it
    fate = fate_without(module, frame, pending, now);
    if (fate == Fate::kHopeless) return fate;
  }
  return fate;
}

// Of a frame that lacks a module: whether it can come.
FrameAssembly::Fate FrameAssembly::fate_without(std::uint32_t module, std::uint64_t frame, const Pending& pending,
                                                Clock::time_point now) const {
  const std::string& owner = owner_of(module, pending);
  const auto found = nodes_.find(owner);
  if (found == nodes_.end()) return Fate::kWaits;  // it has yet to come
  const Node& node = found->second;
  // Nodes send frame after frame: one that has begun a later frame will not complete this one.
  if (node.is_here && node.latest_frame > frame) return Fate::kHopeless;
  const bool has_returned = pending.swap && node.connection > pending.swap->event;
  if ((!node.is_here || has_returned) && now - node.last_sign >= kReturnPatience) return Fate::kHopeless;
  return is_passed_over(module, owner, frame) && starves_others(pending) ? Fate::kHopeless : Fate::kWaits;
}

// Whether a later frame goes without that node's image of the module: the node is late, or out.
bool FrameAssembly::is_passed_over(std::uint32_t module, const std::string& owner, std::uint64_t frame) const {
  if (!latest_swapped_ || *latest_swapped_ <= frame) return false;
  if (latest_swap_.stale.contains(module)) return true;
  const auto named = latest_swap_.owners.find(module);
  return named != latest_swap_.owners.end() && named->second != owner;
}

// Whether a node cannot send anything as long as the frame waits.
bool FrameAssembly::starves_others(const Pending& pending) const {
  return std::ranges::any_of(pending.nodes, [&](const auto& entry) {
    const auto node = nodes_.find(entry.first);
    return node != nodes_.end() && node->second.credit.is_spent();
  });
}

std::optional<ShownFrame> FrameAssembly::next_frame(Clock::time_point now) {
  for (auto at = pending_.begin(); at != pending_.end();) {
    const auto here = at++;
    auto& [frame, pending] = *here;
    const bool patience_is_over = pending.latest_arrival && now - *pending.latest_arrival >= kSwapPatience;
    if (!pending.swap && !patience_is_over) continue;
    switch (fate(frame, pending, now)) {
      case Fate::kWaits:
        continue;
      case Fate::kHopeless:
        // Without its swap it may still come to be shown with modules marked stale.
        if (pending.swap) drop(here);
        continue;
      case Fate::kWhole:
        break;
    }
    const std::uint64_t number = frame;
    while (pending_.begin()->first < number) drop(pending_.begin());
    auto whole = pending_.extract(here);
    for (const auto& [name, from] : whole.mapped().nodes) release(name, from);
    return show(number, std::move(whole.mapped()));
  }
  return std::nullopt;
}

ShownFrame FrameAssembly::show(std::uint64_t frame, Pending&& pending) {
  ShownFrame result{frame, {}, 0};
  for (std::uint32_t module = 0; module < shown_.size(); ++module) {
    const bool stale = !is_waited_for(module, pending.swap);
    const auto from = pending.nodes.find(owner_of(module, pending));
    if (!stale) shown_[module] = std::move(from->second.modules.at(module));
    shown_[module].stale = stale;
    if (!stale) ++result.fresh_modules;
  }
  last_shown_ = frame;
  result.modules = shown_;
  return result;
}

void FrameAssembly::drop(std::map<std::uint64_t, Pending>::iterator pending) {
  for (const auto& [name, from] : pending->second.nodes) release(name, from);
  pending_.erase(pending);
  ++dropped_frames_;
}

void FrameAssembly::release(const std::string& name, const FromNode& from) {
  const auto node = nodes_.find(name);
  if (node != nodes_.end()) node->second.credit.released(from.here, from.bytes);
}

}  // namespace lfd::display
