// The state as it is told, and the assets that it names.
#include "base/log.h"
#include "proto/state.h"
#include "rendernode/node/daemon.h"

namespace lfd::node {

void Daemon::take_snapshot(const proto::Snapshot& snapshot) {
  follower_.snapshot_came(snapshot.state());
  if (preparation_ && preparation_->is_built) forget_prepared();  // the update that showed it may be the one missed
  if (!snapshot.images_endpoint().empty()) use_images_endpoint(snapshot.images_endpoint());
  follow_assets();
}

void Daemon::hear_state() {
  if (!state_socket_) return;
  while (const auto message = state_socket_->receive()) {
    const auto& envelope = message->envelope;
    if (envelope.session() != session_) continue;  // another controller's, that this node has not joined (yet)
    last_heard_ = Clock::now();
    switch (envelope.body_case()) {
      case proto::Envelope::kUpdate:
        follower_.update_came(envelope.update());
        if (envelope.update().prepared() != 0) {
          prepared_shown_ = envelope.update().prepared();
          prepared_sequence_ = envelope.update().sequence();
        }
        if (envelope.update().has_images_endpoint()) use_images_endpoint(envelope.update().images_endpoint());
        follow_assets();
        break;
      case proto::Envelope::kBegin:
        follower_.pulse_came(envelope.begin().sequence());
        take_begin(envelope.begin());
        break;
      case proto::Envelope::kPulse:
        follower_.pulse_came(envelope.pulse().sequence());
        hears_state_ = true;
        break;
      case proto::Envelope::kQuit:
        log::info("the controller says quit: {}", envelope.quit().reason());
        ended_ = true;
        break;
      default:
        break;
    }
  }
}

// Asks for what is missing; once all is here, the state can be drawn, and the controller hears its hash.
void Daemon::follow_assets() {
  const auto& state = follower_.state();
  if (!state || !state->has_scene() || (state == ready_state_ && gatherer_.complete())) return;
  gatherer_.want(state->scene(), preparation_ ? &preparation_->state->scene() : nullptr);
  for (const auto& want : gatherer_.next_requests(Clock::now())) {
    proto::Envelope request;
    *request.mutable_want() = want;
    if (!bulk_ || !bulk_->send(request)) {
      gatherer_.ask_again();
      break;
    }
  }
  if (!gatherer_.has_all_of(state->scene())) {
    rehearses_ = rehearsed_ = false;  // what is missing is to be uploaded
    return;
  }
  ready_state_ = state;
  ready_assets_ = std::make_shared<const Assets>(gatherer_.assets());
  const std::string hash = follower_.hash();
  if (hash == ready_hash_) return;
  ready_hash_ = hash;
  next_words_ = Clock::now();
}

void Daemon::hear_bulk() {
  if (!bulk_) return;
  bool any_came = false;
  while (const auto message = bulk_->receive()) {
    if (message->envelope.has_not_found()) {
      log::info("the controller has no asset {} any more", message->envelope.not_found().hash());
      gatherer_.not_found(message->envelope.not_found().hash());
    }
    if (!message->envelope.has_chunk()) continue;
    any_came = true;
    if (const Status came = gatherer_.piece_came(message->envelope.chunk(), message->payload.text()); !came) {
      log::warn("{}", came.error().message());
    }
  }
  // What is not found is not asked for again at once: news of the other scene is on its way.
  if (any_came) follow_assets();
  build_prepared();
}

}  // namespace lfd::node
