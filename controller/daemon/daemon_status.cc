// What a cluster tells of itself: to control clients, to the service manager, to Prometheus.
#include <algorithm>

#include "base/log.h"
#include "controller/cluster_page.h"
#include "controller/daemon/daemon.h"

namespace lfd::controller {
namespace {

constexpr auto kLookPause = std::chrono::milliseconds(500);

}  // namespace

proto::Status Daemon::status(Clock::time_point now) const {
  proto::Status status;
  const proto::State& state = stage_.store().state();
  status.set_deployment(options_.deployment.message.name());
  status.set_scene(state.scene().name());
  status.set_frame(log_.last_swapped().value_or(0));
  status.set_sequence(state.sequence());
  status.set_state_hash(stage_.store().hash());
  status.set_frames_per_second(log_.frames_per_second(now));
  *status.mutable_roi() = state.roi();
  *status.mutable_render() = state.render();
  status.set_late_frames(log_.late_frames());
  if (stage_.has_scene()) status.mutable_scene_warning()->Add(stage_.warnings().begin(), stage_.warnings().end());
  status.set_stale_modules(static_cast<std::uint32_t>(log_.stale_modules().size()));
  status.set_module_count(static_cast<std::uint32_t>(options_.deployment.display.modules.size()));
  for (const Peer* peer : members_.peers()) {
    proto::PeerStatus& entry = *status.add_peer();
    entry.set_role(peer->role);
    entry.set_name(peer->name);
    entry.set_state(peer->phase == Phase::kReady && late_.is_late(peer->name) ? "late" : name_of(peer->phase));
    entry.set_state_hash(peer->state_hash);
    entry.set_process(peer->process);
    if (peer->role != proto::NODE) continue;
    entry.set_spare(shares_.is_spare(peer->name));
    // It keeps modules ready that it has given back, but does not draw them.
    if (entry.spare() && shares_.stands_in_for(peer->name).empty()) continue;
    for (const std::uint32_t module : shares_.of(peer->name)) entry.add_module(module);
  }
  status.set_refused_messages(links_.control.refused() + links_.state.refused() + links_.bulk.refused());
  stats_.fill(status, log_.stale_modules(), now);
  return status;
}

void Daemon::serve(Clock::time_point now) {
  service_.alive(now);
  if (now < next_look_) return;
  next_look_ = now + kLookPause;
  if (!service_.is_told_status() && !options_.metrics) return;
  const proto::Status told = status(now);
  service_.status(fmt::format("\"{}\": frame {}, {:.1f} frames per second, {} of {} modules stale", told.scene(),
                              told.frame(), told.frames_per_second(), told.stale_modules(), told.module_count()));
  if (options_.metrics) options_.metrics->publish(cluster_page(told, stats_));
}

}  // namespace lfd::controller
