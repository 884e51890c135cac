// Counting, and keeping the last of everything.
#include "controller/cluster_stats.h"

#include <algorithm>
#include <set>

#include "base/log.h"
#include "base/time_of_day.h"

namespace lfd::controller {
namespace {

constexpr std::size_t kRemembered = 256;   // frames; a display that shows later than that is hardly one
constexpr std::size_t kMostOfAName = 100;  // of a stranger
constexpr std::size_t kMostOfAFault = 500;

}  // namespace

void ClusterStats::begun(std::uint64_t frame, Clock::time_point now) {
  begun_.push_back({frame, now});
  if (begun_.size() > kRemembered) begun_.pop_front();
}

std::optional<double> ClusterStats::milliseconds_since_begin(std::uint64_t frame, Clock::time_point now) const {
  const auto found = std::ranges::lower_bound(begun_, frame, {}, &Begun::frame);
  if (found == begun_.end() || found->frame != frame) return std::nullopt;
  return milliseconds(now - found->at);
}

void ClusterStats::ready(const std::string& node, const proto::Ready& ready, Clock::time_point now) {
  const auto after_ms = milliseconds_since_begin(ready.frame(), now);
  const auto entry = peers_.find(node);
  if (!after_ms || entry == peers_.end()) return;
  if (!ready.report().error().empty())
    return fault(node, fmt::format("frame {}: {}", ready.frame(), ready.report().error()));
  PeerEntry& peer = entry->second;
  peer.frames.happened(now);
  peer.begin_to_ready_ms = *after_ms;
  peer.passes = ready.report().pass();
  peer.occlusion_choice = ready.report().occlusion_choice();
  peer.image_bytes += ready.report().image_bytes();
}

void ClusterStats::swapped(const FrameBarrier::Swap& swap, Clock::time_point now) {
  ++swapped_frames_;
  begin_to_swap_ms_ = milliseconds(now - swap.begun);
  begin_to_swap_.observe_ms(begin_to_swap_ms_);
  if (!swap.late) return;
  for (const std::string& node : swap.missing)
    fault(node, fmt::format("frame {}: late at the deadline, after {:.0f} ms", swap.frame, begin_to_swap_ms_));
}

void ClusterStats::shown(const std::string& display, std::uint64_t frame, Clock::time_point now) {
  if (const auto entry = peers_.find(display); entry != peers_.end()) entry->second.frames.happened(now);
  ++shown_frames_;
  const auto after_ms = milliseconds_since_begin(frame, now);
  if (!after_ms) return;
  begin_to_shown_ms_ = *after_ms;
  begin_to_shown_.observe_ms(*after_ms);
}

void ClusterStats::keep_only(const std::set<std::string>& peers) {
  std::erase_if(peers_, [&](const auto& entry) { return !peers.contains(entry.first); });
}

void ClusterStats::fault(const std::string& peer, const std::string& why) {
  ++faults_;
  const std::string_view what = std::string_view(why).substr(0, kMostOfAFault);
  const std::string now = time_of_day();
  last_fault_ = peer.empty() ? fmt::format("{} {}", now, what) : fmt::format("{} \"{}\": {}", now, peer, what);
  const auto entry = peers_.find(peer);
  if (entry == peers_.end()) return;
  ++entry->second.faults;
  entry->second.last_fault = fmt::format("{} {}", now, what);
}

void ClusterStats::join_refused(const std::string& name, const std::string& why) {
  refused();
  fault(name.substr(0, kMostOfAName), fmt::format("refused: {}", why));
}

std::uint64_t ClusterStats::faults(const std::string& peer) const {
  const auto entry = peers_.find(peer);
  return peer.empty() ? faults_ : entry == peers_.end() ? 0 : entry->second.faults;
}

void ClusterStats::fill(proto::Status& status, const std::vector<std::uint32_t>& stale_modules,
                        Clock::time_point now) const {
  status.set_begin_to_swap_ms(begin_to_swap_ms_);
  status.set_begin_to_shown_ms(begin_to_shown_ms_);
  status.set_shown_frames(shown_frames_);
  status.set_published_bytes(published_bytes_);
  status.set_refused_messages(status.refused_messages() + refused_messages_);
  status.set_last_fault(last_fault_);
  status.set_up_s(milliseconds(now - started_) / 1000);
  const std::set<std::uint32_t> stale(stale_modules.begin(), stale_modules.end());
  for (proto::PeerStatus& entry : *status.mutable_peer()) {
    const auto count = std::ranges::count_if(entry.module(), [&](std::uint32_t m) { return stale.contains(m); });
    entry.set_stale_modules(static_cast<std::uint32_t>(count));
    const auto known = peers_.find(entry.name());
    if (known == peers_.end()) continue;
    const PeerEntry& peer = known->second;
    entry.set_frames_per_second(peer.frames.per_second(now));
    entry.set_begin_to_ready_ms(peer.begin_to_ready_ms);
    entry.mutable_pass()->CopyFrom(peer.passes);
    entry.set_image_bytes(peer.image_bytes);
    entry.set_occlusion_choice(peer.occlusion_choice);
    entry.set_last_fault(peer.last_fault);
  }
}

}  // namespace lfd::controller
