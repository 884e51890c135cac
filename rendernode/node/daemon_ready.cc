// When the controller may count on this node.
#include <utility>

#include "base/log.h"
#include "rendernode/node/daemon.h"

namespace lfd::node {
namespace {

constexpr auto kRehearsalPause = std::chrono::seconds(1);  // after one that failed

}  // namespace

bool Daemon::holds_state() const { return ready_state_ && ready_state_ == follower_.state(); }

bool Daemon::can_draw() const {
  const bool has_display = sink_ == proto::Deployment::DISPLAY && !images_endpoint_.empty();
  return !drawing_ || (drawing_started_ && (rehearsed_ || !may_drop_) && (!has_display || outbox_.is_known()));
}

// Empty: not yet. One that was away may hold an older state, which the controller remembers, while the assets of the
// newest are on their way.
std::string Daemon::hash_to_say() const { return hears_state_ && holds_state() && can_draw() ? ready_hash_ : ""; }

// The first picture of assets takes long: shaders are compiled, meshes and textures uploaded. Where there is a deadline
// it is drawn for nobody, and meanwhile a spare may go on.
void Daemon::rehearse(Clock::time_point now) {
  if (!may_drop_ || rehearses_ || !drawing_ || finishing_ || !drawing_started_ || !holds_state()) return;
  if (now < next_rehearsal_) return;
  DrawJob job;
  job.state = ready_state_;
  job.assets = ready_assets_;
  rehearses_ = drawing_->draw(std::move(job));
  if (rehearses_) ++rehearsals_;
}

void Daemon::rehearsal_ended(const std::string& error) {
  if (--rehearsals_ > 0) return;  // assets have come since
  rehearsed_ = rehearses_ && error.empty();
  if (error != std::exchange(rehearsal_error_, error) && !error.empty())
    log::error("a first picture cannot be drawn; until one can, this node takes no part: {}", error);
  if (error.empty()) {
    next_words_ = Clock::now();
  } else {
    rehearses_ = false;
    next_rehearsal_ = Clock::now() + kRehearsalPause;
  }
}

}  // namespace lfd::node
