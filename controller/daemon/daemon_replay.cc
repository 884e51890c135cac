// A recorded show: its frames, and its end.
#include <algorithm>

#include "base/log.h"
#include "controller/daemon/daemon.h"

namespace lfd::controller {

Status Daemon::start_replay() {
  log::info("{}", options_.replay->title());
  const std::string& note = options_.replay->recording().contents().note;
  if (!note.empty()) log::warn("the recording is not whole: {}", note);
  first_shown_ = Clock::now();
  service_.ready();
  take_cue();  // whoever joins is given the first frame's state
  return replay_failed_;
}

bool Daemon::is_due(Clock::time_point now) const {
  return options_.replay ? !end_ && options_.replay->due(now) : pacing_.due(now);
}

bool Daemon::waits_for_every_node() const {
  return options_.replay && (options_.replay->waits_for_every_node() || !options_.replay->has_begun());
}

bool Daemon::take_cue() {
  if (!options_.replay || !options_.replay->next()) return true;
  const Replay::Cue& cue = *options_.replay->next();
  barrier_.continue_at(cue.frame);
  auto change = options_.replay->take_change();
  if (!change) return true;
  const auto update = stage_.show_recorded(std::move(change->update), std::move(change->assets));
  if (update) {
    publish(*update);
    return true;
  }
  replay_failed_ = options_.replay->recording().at(
      cue.offset, update.error().within(fmt::format("frame {} cannot be shown here", cue.frame)));
  end_ = "the recording cannot be shown any further";
  return false;
}

void Daemon::cue_begun(Clock::time_point now) {
  if (!options_.replay) return;
  if (const Status read = options_.replay->begun(now); !read) replay_failed_ = read;
}

void Daemon::drawn_of_replay(const Peer& peer, const proto::Ready& ready) {
  if (!options_.replay) return;
  const Status same = options_.replay->drawn(ready.frame(), peer.name, ready.report().state_hash());
  if (same) return;
  log::error("{}", same.error().message());
  if (replay_failed_) replay_failed_ = same;
}

void Daemon::end_replay(Clock::time_point now) {
  if (end_ || !options_.replay || options_.replay->next() != nullptr || barrier_.in_flight() > 0) return;
  const auto last = options_.replay->last_frame();
  // Without a deadline it is waited for until it is shown, or known to be lost.
  const bool is_lost = last && !has_deadline() && has_display_sink() && !unshown_.contains(*last);
  const bool is_shown = !last || log_.all_shown(*last, 1);
  if (!is_shown && !is_never_shown(now) && !is_lost) return;
  if (!is_shown && !has_deadline() && has_display_sink() && replay_failed_) replay_failed_ = Error(kDisplayIsOut);
  log::info("{}", options_.replay->summary());
  end_ = "the recording is over";
}

Status Daemon::may_ask(const proto::Request& request) const {
  if (!options_.replay || request.has_status() || request.has_follow() || request.has_quit()) return {};
  return Error("a recording is replayed: what it shows cannot be changed");
}

}  // namespace lfd::controller
