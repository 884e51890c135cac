// Who draws what, as members come and go: what Shares decides is told to the nodes.
#include <algorithm>

#include "base/log.h"
#include "controller/daemon/daemon.h"
#include "proto/module_ranges.h"

namespace lfd::controller {

// A node that has never come counts as away only once it could have: nodes of a cluster start in any order.
std::map<std::string, Presence> Daemon::presence(Clock::time_point now) const {
  const Clock::duration patience = members_.patience();
  const bool should_be_here = first_shown_ && now - *first_shown_ > patience;
  std::map<std::string, Presence> presence;
  for (const auto& [name, modules] : assignment_) {
    const Phase phase = members_.find(name)->phase;
    const bool away = phase == Phase::kOut || (phase == Phase::kAbsent && (should_be_here || shares_.is_spare(name)));
    presence[name] = phase == Phase::kReady ? Presence::kReady : away ? Presence::kAway : Presence::kLoading;
  }
  return presence;
}

void Daemon::settle_shares(Clock::time_point now) {
  if (!stage_.has_scene()) return;
  std::map<std::string, std::string> stood_in;  // spares, for whom
  for (const auto& [name, modules] : assignment_) {
    if (shares_.is_spare(name)) stood_in[name] = shares_.stands_in_for(name);
  }
  for (const std::string& spare : shares_.settle(presence(now))) {
    const std::vector<std::uint32_t>& modules = shares_.of(spare);
    log::warn("\"{}\" takes over modules {} of \"{}\"", spare,
              module_ranges(std::vector<int>(modules.begin(), modules.end())), shares_.stands_in_for(spare));
    stats_.fault(shares_.stands_in_for(spare), fmt::format("\"{}\" stands in for it", spare));
    members_.reassigned(spare);
    change_.gone(spare);
    barrier_.gone(spare);  // it leaves what it may still be drawing
    const Peer& peer = *members_.find(spare);
    if (!peer.last_heard) continue;  // its welcome will say it
    proto::Envelope envelope;
    envelope.mutable_assign()->set_share(shares_.number(spare));
    for (const std::uint32_t module : modules) envelope.mutable_assign()->add_modules(module);
    send(peer.address, envelope);
    prepares_too(peer);
  }
  for (const auto& [spare, owner] : stood_in) {
    if (!owner.empty() && shares_.stands_in_for(spare) != owner)
      log::info("\"{}\" draws modules of \"{}\" no longer", spare, owner);
  }
}

bool Daemon::is_settled(const std::string& node, Clock::time_point now) const {
  if (assignment_.at(node).empty()) return true;
  const auto here = presence(now);
  for (const auto& [name, modules] : assignment_) {
    if (shares_.is_spare(name) && shares_.stands_in_for(name) == node) return here.at(name) == Presence::kReady;
  }
  return here.at(node) != Presence::kLoading && members_.find(node)->phase != Phase::kAbsent;
}

}  // namespace lfd::controller
