// Taking over and giving back.
#include "controller/shares.h"

#include <algorithm>

#include "base/check.h"

namespace lfd::controller {

Shares::Shares(Assignment own, std::vector<std::string> spares, proto::Deployment::GiveBack give_back)
    : own_(std::move(own)), spares_(std::move(spares)), give_back_(give_back) {
  for (const auto& [node, modules] : own_)
    held_[node] = {.modules = modules, .number = 1, .owner = {}, .active = false};
  for (const std::string& spare : spares_) LFD_CHECK(own_.at(spare).empty(), "a spare has no modules of its own");
}

bool Shares::is_spare(const std::string& node) const { return std::ranges::find(spares_, node) != spares_.end(); }

std::string Shares::stands_in_for(const std::string& spare) const {
  const Held& held = held_.at(spare);
  return held.active ? held.owner : "";
}

bool Shares::is_stood_in_for(const std::string& owner) const {
  return std::ranges::any_of(held_,
                             [&](const auto& entry) { return entry.second.active && entry.second.owner == owner; });
}

void Shares::give_back(const std::map<std::string, Presence>& presence) {
  for (const std::string& spare : spares_) {
    Held& held = held_.at(spare);
    if (!held.active) continue;
    const bool may_keep = give_back_ == proto::Deployment::NEVER && presence.at(spare) == Presence::kReady;
    const bool owner_draws = presence.at(held.owner) == Presence::kReady && !may_keep;
    if (owner_draws || presence.at(spare) == Presence::kAway) held.active = false;
  }
}

// One that holds these very modules already is quickest; then one that can draw.
std::string Shares::free_spare_for(const std::string& owner, const std::map<std::string, Presence>& presence) const {
  const auto rank = [&](const std::string& spare) {
    const Held& held = held_.at(spare);
    if (held.active || presence.at(spare) == Presence::kAway) return 0;
    return 1 + (presence.at(spare) == Presence::kReady ? 1 : 0) + (held.owner == owner ? 2 : 0);
  };
  const auto best = std::ranges::max_element(spares_, {}, rank);
  return best == spares_.end() || rank(*best) == 0 ? "" : *best;
}

std::vector<std::string> Shares::settle(const std::map<std::string, Presence>& presence) {
  give_back(presence);
  std::vector<std::string> changed;
  for (const auto& [owner, modules] : own_) {
    if (modules.empty() || presence.at(owner) != Presence::kAway || is_stood_in_for(owner)) continue;
    const std::string spare = free_spare_for(owner, presence);
    if (spare.empty()) break;  // there is none for anybody
    Held& held = held_.at(spare);
    held.active = true;
    if (held.owner == owner) continue;
    held.owner = owner;
    held.modules = modules;
    ++held.number;
    changed.push_back(spare);
  }
  return changed;
}

Assignment Shares::drawing(const std::map<std::string, Presence>& presence) const {
  Assignment drawing;
  for (const auto& [node, held] : held_) {
    const bool draws = is_spare(node) ? held.active : !is_stood_in_for(node);
    if (draws && !held.modules.empty() && presence.at(node) == Presence::kReady) drawing[node] = held.modules;
  }
  return drawing;
}

}  // namespace lfd::controller
