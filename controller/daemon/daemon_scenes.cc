// Scenes as they come: the first is shown at once, a later one when all nodes that draw have prepared it.
#include "base/log.h"
#include "controller/daemon/daemon.h"

namespace lfd::controller {

const Assets* Daemon::assets_for(const std::string& hash) const {
  const bool is_next = next_scene_ && next_scene_->scene && next_scene_->scene->data.assets.contains(hash);
  return is_next ? &next_scene_->scene->data.assets : &stage_.assets();
}

Status Daemon::take_scene(SceneArrival arrival, Clock::time_point now) {
  Result<proto::Update> update =
      arrival.scene ? stage_.preview(*arrival.scene) : Result<proto::Update>(arrival.scene.error());
  if (!update && arrival.asker.empty()) return update.error().within("scene");
  if (!update) {
    stats_.fault({}, update.error().within("scene").message());
    log::error("scene: {}", update.error().message());
    reply(arrival.asker, arrival.request_id, update.error());
    return {};
  }
  // Those that draw, or are about to; others prepare it when they come.
  std::vector<std::string> nodes;
  for (const Peer* peer : members_.peers()) {
    const bool is_here = peer->role == proto::NODE && peer->lives() && peer->last_heard;
    if (is_here && stage_.has_scene()) nodes.push_back(peer->name);
  }
  proto::Envelope envelope;
  envelope.mutable_prepare()->set_number(change_.start(nodes));
  *envelope.mutable_prepare()->mutable_update() = *std::move(update);
  next_scene_ = std::move(arrival);
  for (const std::string& node : nodes) send(members_.find(node)->address, envelope);
  if (!nodes.empty()) log::info("scene: {} nodes prepare it; the old one is shown until then", nodes.size());
  settle_scene(now);
  return {};
}

// Else it would be ready with the old scene just before it goes, and everybody would wait for it to load the new one.
void Daemon::prepares_too(const Peer& peer) {
  if (!change_.is_pending() || peer.role != proto::NODE) return;
  Result<proto::Update> update = stage_.preview(*next_scene_->scene);
  if (!update) return;  // settings that do not fit it have come in between: it will not be shown
  change_.joins(peer.name);
  log::info("scene: \"{}\" prepares it too", peer.name);
  proto::Envelope envelope;
  envelope.mutable_prepare()->set_number(change_.number());
  *envelope.mutable_prepare()->mutable_update() = *std::move(update);
  send(peer.address, envelope);
}

void Daemon::settle_scene(Clock::time_point now) {
  if (!change_.is_pending()) return;
  switch (change_.verdict()) {
    case SceneChange::Verdict::kWait:
      return;
    case SceneChange::Verdict::kShow:
      return show_next_scene(now);
    case SceneChange::Verdict::kRefuse:
      return refuse_next_scene(Error(change_.error()));
  }
}

void Daemon::show_next_scene(Clock::time_point now) {
  SceneArrival next = *std::exchange(next_scene_, std::nullopt);
  Result<proto::Update> update = stage_.show(*std::move(next.scene));
  if (!update) {  // settings that do not fit it have come in between
    next_scene_ = std::move(next);
    return refuse_next_scene(update.error());
  }
  update->set_prepared(change_.number());
  change_.finish();
  log::info("scene: {} is shown", stage_.store().state().scene().name());
  for (const std::string& warning : stage_.warnings()) log::warn("scene: {}", warning);
  publish(*update);
  service_.ready();
  if (!first_shown_) first_shown_ = now;
  for (const Peer* peer : members_.peers()) {
    if (peer->lives() && !peer->last_heard) welcome(*peer, now);
  }
  if (!next.asker.empty()) reply(next.asker, next.request_id, {});
}

void Daemon::refuse_next_scene(const Error& why) {
  const SceneArrival next = *std::exchange(next_scene_, std::nullopt);
  change_.finish();
  stats_.fault({}, why.within("scene").message());
  log::error("scene: {}; the old one stays", why.message());
  proto::Envelope envelope;
  envelope.mutable_prepare()->set_number(change_.number());
  for (const Peer* peer : members_.peers()) {
    if (peer->role == proto::NODE && peer->lives() && peer->last_heard) send(peer->address, envelope);
  }
  if (!next.asker.empty()) reply(next.asker, next.request_id, why);
}

}  // namespace lfd::controller
