// Nodes and the display: joining, keeping up, going.
#include <set>

#include "base/log.h"
#include "controller/daemon/daemon.h"
#include "proto/calibration_file.h"

namespace lfd::controller {

void Daemon::take_join(const wire::Message& message, Clock::time_point now) {
  if (!lets_join(message, now)) return;
  const proto::Join& join = message.envelope.join();
  const Peer* known = members_.at(message.peer);
  const bool asks_again = known != nullptr && known->name == join.name() && !known->last_heard;
  const std::string images_before = images_endpoint();
  const Result<std::optional<std::string>> joined = members_.join(join, message.peer, now, message.user);
  if (!joined) return refuse_join(message, joined.error(), now);
  if (!*joined) return log::debug("\"{}\" (process {}) comes under a name that may live", join.name(), join.process());
  const std::string& name = **joined;
  stats_.joined(name);
  std::set<std::string> remembered;
  for (const Peer* peer : members_.peers()) remembered.insert(peer->name);
  stats_.keep_only(remembered);
  change_.gone(name);
  barrier_.gone(name);  // whatever it drew before it joined anew is lost
  if (!asks_again) log::info("\"{}\" joins (process {})", name, join.process());
  const Peer& peer = *members_.find(name);
  if (peer.role == proto::DISPLAY && !asks_again) lose_unshown("the display came anew, and has not shown every frame");
  const bool moved = !asks_again || images_endpoint() != images_before;
  if (peer.role == proto::DISPLAY && moved) publish_images_endpoint();
  if (stage_.has_scene()) welcome(peer, now);
}

void Daemon::take_heartbeat(const wire::Message& message) {
  const Peer* peer = members_.at(message.peer);
  if (peer == nullptr) {
    proto::Refused refused;
    refused.set_reason("not a member of this cluster");
    refused.set_not_a_member(true);
    return refuse(message.peer, std::move(refused));
  }
  const std::string& hash = message.envelope.heartbeat().state_hash();
  const Phase before = peer->phase;
  const bool can_draw = peer->role != proto::NODE || message.envelope.heartbeat().share() == shares_.number(peer->name);
  members_.holds(message.peer, hash, can_draw && stage_.store().remembers(hash));
  if (peer->phase != before) log::info("\"{}\" is ready", peer->name);
}

void Daemon::welcome(const Peer& peer, Clock::time_point now) {
  const Deployment& deployment = options_.deployment;
  proto::Envelope envelope;
  proto::Welcome& welcome = *envelope.mutable_welcome();
  welcome.set_state_endpoint(links_.state.endpoint());
  welcome.set_bulk_endpoint(links_.bulk.endpoint());
  *welcome.mutable_display() = write_calibration(deployment.display);
  if (peer.role == proto::NODE) {
    for (const std::uint32_t module : shares_.of(peer.name)) welcome.add_modules(module);
    welcome.set_share(shares_.number(peer.name));
  } else {
    for (const std::uint32_t module : modules_beside(assignment_, {})) welcome.add_modules(module);
  }
  welcome.set_images_endpoint(images_endpoint());
  welcome.set_heartbeat_ms(static_cast<std::uint32_t>(deployment.pacing.heartbeat.count()));
  welcome.set_hang_s(static_cast<std::uint32_t>(deployment.pacing.hang.count()));
  welcome.set_may_drop(has_deadline());
  *welcome.mutable_stream() = deployment.message.stream();
  welcome.set_sink(static_cast<std::uint32_t>(deployment.message.sink()));
  *welcome.mutable_snapshot() = snapshot();
  send(peer.address, envelope);
  members_.welcomed(peer.name, now);
  prepares_too(peer);
}

void Daemon::peer_is_gone(const std::string& name, const char* why) {
  log::warn("\"{}\" is out: {}", name, why);
  change_.gone(name);
  stats_.fault(name, fmt::format("out: {}", why));
  barrier_.gone(name);
  late_.gone(name);
  if (members_.find(name)->role != proto::DISPLAY) return;
  lose_unshown(kDisplayIsOut);
  publish_images_endpoint();
}

void Daemon::peer_is_back(const Peer& peer) {
  log::info("\"{}\" is heard again", peer.name);
  if (stage_.has_scene()) send_snapshot(peer.address);
  if (peer.role == proto::DISPLAY) publish_images_endpoint();
  prepares_too(peer);
}

void Daemon::refuse(const std::string& address, proto::Refused refused) {
  proto::Envelope envelope;
  *envelope.mutable_refused() = std::move(refused);
  send(address, std::move(envelope));
}

proto::Snapshot Daemon::snapshot() const {
  proto::Snapshot snapshot;
  *snapshot.mutable_state() = stage_.store().state();
  snapshot.set_images_endpoint(images_endpoint());
  return snapshot;
}

void Daemon::send_snapshot(const std::string& address) {
  proto::Envelope envelope;
  *envelope.mutable_snapshot() = snapshot();
  send(address, std::move(envelope));
}

void Daemon::publish_images_endpoint() {
  proto::Update update;
  update.set_images_endpoint(images_endpoint());
  publish(stage_.number(std::move(update)));
}

std::string Daemon::images_endpoint() const {
  const Peer* display = members_.display();
  return display == nullptr ? "" : display->images_endpoint;
}

}  // namespace lfd::controller
