// Joining, being heard and going.
#include "controller/membership.h"

#include <algorithm>

#include "base/log.h"

namespace lfd::controller {

namespace {

// Of names, versions and hashes; what peers send beyond it is neither kept nor repeated.
constexpr std::size_t kMostText = 64;
constexpr std::size_t kMostEndpoint = 256;

}  // namespace

const char* name_of(Phase phase) {
  switch (phase) {
    case Phase::kAbsent:
      return "absent";
    case Phase::kJoining:
      return "joining";
    case Phase::kReady:
      return "ready";
    case Phase::kOut:
      return "out";
  }
  return "unknown";
}

Membership::Membership(Rules rules) : rules_(std::move(rules)) {
  for (const std::string& name : rules_.nodes) peers_[name].name = name;
}

Result<std::optional<std::string>> Membership::join(const proto::Join& join, const std::string& address,
                                                    Clock::time_point now, const std::string& user) {
  LFD_TRY_STATUS(check(join));
  LFD_TRY(const bool may_come, may_take_name(join, address, now));
  if (!may_come) return std::optional<std::string>();
  if (const Peer* before = living_of(join)) peers_[before->name].phase = Phase::kOut;
  Peer& peer = peers_[join.name()];
  peer = Peer{.role = join.role(),
              .name = join.name(),
              .phase = Phase::kJoining,
              .address = address,
              .state_hash = {},
              .images_endpoint = join.images_endpoint(),
              .user = user,
              .process = join.process(),
              .last_heard = std::nullopt,
              .last_word = now,
              .rival = std::nullopt};
  forget_displays();
  return std::optional(join.name());
}

Status Membership::check(const proto::Join& join) const {
  if (std::max({join.name().size(), join.version().size(), join.calibration_hash().size()}) > kMostText ||
      join.images_endpoint().size() > kMostEndpoint)
    return Error("a name, version, hash or address that is too long");
  if (join.version() != rules_.version) {
    return Error(fmt::format("version {} does not fit the controller's {}", join.version(), rules_.version));
  }
  // A display may be started without a deployment, and then has no calibration that could be another.
  const bool takes_ours = join.role() == proto::DISPLAY && join.calibration_hash().empty();
  if (!takes_ours && join.calibration_hash() != rules_.calibration_hash) {
    return Error(fmt::format("display calibration {} is not the controller's {}",
                             join.calibration_hash().empty() ? "(none)" : join.calibration_hash(),
                             rules_.calibration_hash));
  }
  const bool is_node = std::ranges::find(rules_.nodes, join.name()) != rules_.nodes.end();
  if (join.role() == proto::NODE && !is_node) {
    return Error(
        fmt::format("the deployment has no node \"{}\"; it has {}", join.name(), fmt::join(rules_.nodes, ", ")));
  }
  if (join.role() == proto::DISPLAY && is_node) return Error(fmt::format("\"{}\" is the name of a node", join.name()));
  if (join.role() != proto::NODE && join.role() != proto::DISPLAY) return Error("only nodes and displays join");
  if (join.name().empty()) return Error("a peer without a name");
  return {};
}

// The living peer whose place it would take: one display at a time, one node of each name.
Peer* Membership::living_of(const proto::Join& join) {
  for (auto& [name, peer] : peers_) {
    const bool same_place = join.role() == proto::DISPLAY ? peer.role == proto::DISPLAY : name == join.name();
    if (same_place && peer.lives()) return &peer;
  }
  return nullptr;
}

Result<bool> Membership::may_take_name(const proto::Join& join, const std::string& address, Clock::time_point now) {
  Peer* living = living_of(join);
  if (living == nullptr) return true;
  if (!living->last_heard && living->name == join.name()) return true;  // it may be gone: nothing is heard of it yet
  const bool same = living->address == address || (join.process() != 0 && living->process == join.process());
  if (same && living->name == join.name()) return true;
  if (!living->rival || living->rival->process != join.process()) living->rival = Peer::Rival{join.process(), now};
  // What was under way when it died may still be heard a little later.
  if (living->last_word > living->rival->since + rules_.heartbeat / 2) {
    living->rival.reset();
    return Error(fmt::format("\"{}\" has joined already, as process {}", living->name, living->process));
  }
  return now - living->rival->since >= kHeartbeatsOfDoubt * rules_.heartbeat;
}

void Membership::reassigned(const std::string& name) {
  Peer& peer = peers_.at(name);
  if (peer.phase == Phase::kReady) peer.phase = Phase::kJoining;
}

void Membership::welcomed(const std::string& name, Clock::time_point now) { peers_.at(name).last_heard = now; }

Membership::Heard Membership::heard(const std::string& address, Clock::time_point now) {
  for (auto& [name, peer] : peers_) {
    if (address.empty() || peer.address != address) continue;
    peer.last_word = now;
    if (peer.lives()) {
      if (peer.last_heard) peer.last_heard = now;
      return Heard::kMember;
    }
    if (peer.role == proto::DISPLAY && display() != nullptr) return Heard::kStranger;
    peer.phase = Phase::kJoining;
    peer.state_hash.clear();
    peer.last_heard = now;
    return Heard::kBack;
  }
  return Heard::kStranger;
}

void Membership::holds(const std::string& address, const std::string& state_hash, bool known) {
  for (auto& [name, peer] : peers_) {
    if (peer.address != address || !peer.lives()) continue;
    peer.state_hash = state_hash.size() <= kMostText ? state_hash : "too long";
    if (known || peer.role == proto::DISPLAY) peer.phase = Phase::kReady;
  }
}

std::optional<std::string> Membership::leave(const std::string& address) {
  for (auto& [name, peer] : peers_) {
    if (peer.address != address || !peer.lives()) continue;
    peer.phase = Phase::kOut;
    peer.address.clear();
    return name;
  }
  return std::nullopt;
}

std::vector<std::string> Membership::expire(Clock::time_point now) {
  forget_displays();
  std::vector<std::string> gone;
  for (auto& [name, peer] : peers_) {
    if (!peer.lives() || !peer.last_heard || now - *peer.last_heard <= rules_.patience) continue;
    peer.phase = Phase::kOut;
    gone.push_back(name);
  }
  return gone;
}

void Membership::forget_displays() {
  const auto is_gone = [](const Peer& peer) { return peer.role == proto::DISPLAY && !peer.lives(); };
  auto too_many =
      std::ranges::count_if(peers_, [&](const auto& entry) { return is_gone(entry.second); }) - kGoneDisplays;
  std::erase_if(peers_, [&](const auto& entry) { return is_gone(entry.second) && too_many-- > 0; });
}

const Peer* Membership::find(const std::string& name) const {
  const auto found = peers_.find(name);
  return found == peers_.end() ? nullptr : &found->second;
}

const Peer* Membership::at(const std::string& address) const {
  for (const auto& [name, peer] : peers_) {
    if (peer.lives() && peer.address == address) return &peer;
  }
  return nullptr;
}

const Peer* Membership::other_at(const std::string& address, const std::string& user) const {
  for (const auto& [name, peer] : peers_) {
    if (!address.empty() && peer.address == address && peer.user != user) return &peer;
  }
  return nullptr;
}

const Peer* Membership::display() const {
  for (const auto& [name, peer] : peers_) {
    if (peer.role == proto::DISPLAY && peer.lives()) return &peer;
  }
  return nullptr;
}

std::vector<const Peer*> Membership::peers() const {
  std::vector<const Peer*> all;
  for (const auto& [name, peer] : peers_) all.push_back(&peer);
  return all;
}

std::vector<std::string> Membership::ready_nodes() const {
  std::vector<std::string> names;
  for (const auto& [name, peer] : peers_) {
    if (peer.role == proto::NODE && peer.phase == Phase::kReady) names.push_back(name);
  }
  return names;
}

}  // namespace lfd::controller
