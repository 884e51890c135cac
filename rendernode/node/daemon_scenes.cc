// A scene that is to come: its assets are gathered and a second thread builds it while the first goes on drawing.
#include "base/large_blocks.h"
#include "base/log.h"
#include "proto/state.h"
#include "rendernode/node/daemon.h"

namespace lfd::node {

void Daemon::take_prepare(const proto::Prepare& message) {
  if (!message.has_update() || !follower_.state()) return drop_prepared();
  if (preparation_ && preparation_->number == message.number()) {  // the controller thought that this node was gone
    if (preparation_->is_built) say_prepared("");
    return;
  }
  forget_prepared();
  auto state = std::make_shared<proto::State>(*follower_.state());
  *state->mutable_scene() = message.update().scene();
  *state->mutable_roi() = message.update().roi();
  *state->mutable_render() = message.update().render();
  preparation_ =
      Preparation{.number = message.number(), .state = std::move(state), .drawing = nullptr, .is_built = false};
  log::info("prepares scene {}", message.update().scene().name());
  follow_assets();
  gatherer_.want(follower_.state()->scene(), &preparation_->state->scene());
  build_prepared();
}

// Once its assets are here.
void Daemon::build_prepared() {
  if (!preparation_ || preparation_->drawing || preparation_->is_built) return;
  if (!gatherer_.has_all_of(preparation_->state->scene())) return;
  if (modules_.empty()) {
    preparation_->is_built = true;
    return say_prepared("");
  }
  preparation_->drawing = std::make_unique<RenderThread>(options_.gpu, *display_, modules_);
  DrawJob job;
  job.state = preparation_->state;
  job.assets = std::make_shared<const Assets>(gatherer_.assets());
  preparation_->drawing->draw(std::move(job));
}

void Daemon::take_prepared_events() {
  while (preparation_ && preparation_->drawing) {
    const auto event = preparation_->drawing->take();
    if (!event) return;
    const bool failed = event->kind == FrameEvent::Kind::kFailed;
    if (!failed && event->kind != FrameEvent::Kind::kReady) continue;
    const std::string error = failed ? event->error : event->result->report.error();
    preparation_->is_built = error.empty();
    if (!preparation_->is_built) log::warn("the scene cannot be drawn here: {}", error);
    say_prepared(error);
    if (!preparation_->is_built) return forget_prepared();
  }
}

void Daemon::say_prepared(const std::string& error) {
  proto::Envelope prepared;
  prepared.mutable_prepared()->set_number(preparation_->number);
  prepared.mutable_prepared()->set_error(error);
  say(prepared);
}

// It is refused: what it alone needed goes at once.
void Daemon::drop_prepared() {
  forget_prepared();
  const auto& state = follower_.state();
  if (!state) return;
  gatherer_.want(state->scene());
  if (state == ready_state_) ready_assets_ = std::make_shared<const Assets>(gatherer_.assets());
  give_memory_back();
}

void Daemon::forget_prepared() {
  if (preparation_ && preparation_->drawing && !preparation_->drawing->stop_within({}))
    retired_.push_back(std::move(preparation_->drawing));
  preparation_.reset();
}

bool Daemon::is_prepared_shown() const {
  return preparation_ && preparation_->is_built && preparation_->drawing && prepared_shown_ != 0 &&
         preparation_->number == prepared_shown_;
}

bool Daemon::shows_prepared(const Begun& begun) const {
  return is_prepared_shown() && begun.begin.sequence() >= prepared_sequence_;
}

// A spare that stands in for nobody hears of no frame: it would hold both scenes until it does. All begins of before
// are drawn, and those that follow are of the new scene: updates and begins come in one order.
void Daemon::switch_at_rest() {
  if (is_prepared_shown() && begun_.empty() && drawing_ && !finishing_ && drawing_->pending() == 0)
    switch_to_prepared();
}

void Daemon::switch_to_prepared() {
  if (finishing_ && !finishing_->stop_within({})) retired_.push_back(std::move(finishing_));
  finishing_ = std::exchange(drawing_, std::move(preparation_->drawing));
  log::info("draws scene {} from now on", preparation_->state->scene().name());
  preparation_.reset();
  drawing_started_ = rehearses_ = rehearsed_ = true;
  rehearsals_ = 0;
}

}  // namespace lfd::node
