// Begin, swap, and the answer to who asked for frames.
#include <algorithm>

#include "base/log.h"
#include "controller/daemon/daemon.h"

namespace lfd::controller {

bool Daemon::has_display_sink() const { return options_.deployment.message.sink() == proto::Deployment::DISPLAY; }

void Daemon::advance(Clock::time_point now) {
  while (true) {
    if (const auto swap = barrier_.swap(now)) {
      finish(*swap, now);
    } else if (may_begin(now)) {
      begin_frame(now);
    } else {
      break;
    }
  }
  answer_frames_asked(now);
}

bool Daemon::may_begin(Clock::time_point now) const {
  if (!stage_.has_scene() || !is_due(now) || !barrier_.may_begin()) return false;
  if (has_display_sink() && members_.display() == nullptr) return false;
  if (drawing(now).empty()) return false;
  if (!asked_ && !waits_for_every_node()) return true;
  // Who asks for frames gets whole ones: a node that has not come yet is waited for, one that died is not.
  return std::ranges::all_of(assignment_, [&](const auto& entry) { return is_settled(entry.first, now); });
}

void Daemon::begin_frame(Clock::time_point now) {
  if (!take_cue()) return;
  if (const auto update = stage_.animate(barrier_.next_frame())) publish(*update);
  const Assignment drawn_by = drawing(now);
  std::vector<std::string> nodes;
  for (const auto& [node, modules] : drawn_by) nodes.push_back(node);
  const std::uint64_t frame = barrier_.begin(nodes, now);
  pacing_.begun(now);
  stats_.begun(frame, now);
  cue_begun(now);
  log_.begun(frame, stage_.roi(), stage_.store().hash(), now);
  proto::Envelope envelope;
  proto::BeginFrame& begin = *envelope.mutable_begin();
  begin.set_frame(frame);
  begin.set_sequence(stage_.store().sequence());
  begin.set_time_modules(asked_ && asked_->time_modules);
  begin.mutable_node()->Add(nodes.begin(), nodes.end());
  open_[frame] = {drawn_by, begin};
  publish(std::move(envelope));
  log::debug("frame {}: begin", frame);
}

void Daemon::take_ready(const Peer& peer, proto::Ready ready, Clock::time_point now) {
  const bool is_drawn = ready.report().error().empty();
  const std::string* hash = log_.state_hash(ready.frame());
  if (is_drawn && hash != nullptr && ready.report().state_hash() != *hash)
    ready.mutable_report()->set_error("it drew another state than the frame's");  // a frame never mixes two
  if (!log_.reported(ready.frame(), peer.name, ready.report())) return;           // it is said again
  if (is_drawn) drawn_of_replay(peer, ready);
  stats_.ready(peer.name, ready, now);
  const bool is_said = said_errors_[peer.name] == ready.report().error();
  said_errors_[peer.name] = ready.report().error();
  if (ready.report().error().empty()) return barrier_.ready(peer.name, ready.frame());
  barrier_.failed(peer.name, ready.frame());
  const std::string error = fmt::format("node \"{}\": frame {}: {}", peer.name, ready.frame(), ready.report().error());
  if (!is_said) log::error("{}", error);
  const bool is_open = !log_.last_swapped() || ready.frame() > *log_.last_swapped();
  if (asked_ && is_open && ready.frame() >= asked_->first && asked_->error.empty()) asked_->error = error;
}

void Daemon::take_shown(const std::string& display, const proto::Shown& shown, Clock::time_point now) {
  const bool is_asked_for = unshown_.contains(shown.frame());
  if (shown.dropped()) {
    if (is_asked_for) lose_unshown(fmt::format("frame {} was not shown: images of it were lost", shown.frame()));
    return;
  }
  unshown_.erase(shown.frame());
  if (!log_.shown(shown.frame(), now)) return;
  stats_.shown(display, shown.frame(), now);
}

void Daemon::lose_unshown(const std::string& why) {
  if (unshown_.empty()) return;
  unshown_.clear();
  if (asked_ && asked_->error.empty()) asked_->error = why;
  if (options_.replay && replay_failed_) replay_failed_ = Error(why);
}

void Daemon::finish(const FrameBarrier::Swap& swap, Clock::time_point now) {
  const Assignment drawn_by = std::move(open_.extract(swap.frame).mapped().drawn_by);
  std::vector<std::uint32_t> fresh;
  proto::Envelope envelope;
  proto::SwapFrame& message = *envelope.mutable_swap();
  message.set_frame(swap.frame);
  for (const std::string& node : swap.ready) {
    const std::vector<std::uint32_t>& modules = drawn_by.at(node);
    proto::Share& share = *message.add_share();
    share.set_node(node);
    share.mutable_module()->Add(modules.begin(), modules.end());
    fresh.insert(fresh.end(), modules.begin(), modules.end());
  }
  const std::vector<std::uint32_t> stale = modules_beside(assignment_, fresh);
  message.mutable_stale_modules()->Add(stale.begin(), stale.end());
  const bool is_waited_for = (asked_ && swap.frame >= asked_->first) || options_.replay;
  if (is_waited_for && has_display_sink() && !has_deadline()) unshown_[swap.frame] = message;
  publish(std::move(envelope));
  log_.swapped(swap, stale, now);
  stats_.swapped(swap, now);
  if (!has_display_sink()) {
    log_.shown(swap.frame, now);
    stats_.shown({}, swap.frame, now);
  }
  last_swap_ = now;
  for (const LateNodes::News& news : late_.swapped(swap.late ? swap.missing : std::vector<std::string>(), now)) {
    if (news.is_late) {
      log::warn("\"{}\" is late: frame {} is shown with its modules as they were", news.node, swap.frame);
    } else {
      log::info("\"{}\" is in time again", news.node);
    }
  }
  log::debug("frame {}: swap after {:.1f} ms, {} modules stale", swap.frame, milliseconds(now - swap.begun),
             stale.size());
}

void Daemon::say_again(Clock::time_point now) {
  if (has_deadline()) return;
  for (const FrameBarrier::Waiting& waiting : barrier_.waiting_since(now - options_.deployment.pacing.heartbeat)) {
    proto::Envelope envelope;
    *envelope.mutable_begin() = open_.at(waiting.frame).begin;
    envelope.mutable_begin()->set_again(true);
    envelope.mutable_begin()->mutable_node()->Assign(waiting.nodes.begin(), waiting.nodes.end());
    publish(std::move(envelope));
  }
  std::size_t count = 0;
  for (const auto& [frame, swap] : unshown_) {
    if (++count > FrameBarrier::kInFlight) break;
    proto::Envelope envelope;
    *envelope.mutable_swap() = swap;
    envelope.mutable_swap()->set_again(true);
    publish(std::move(envelope));
  }
}

bool Daemon::is_never_shown(Clock::time_point now) const {
  return members_.display() == nullptr || (has_deadline() && last_swap_ && now - *last_swap_ > members_.patience());
}

void Daemon::answer_frames_asked(Clock::time_point now) {
  if (!asked_) return;
  const std::uint64_t end = asked_->first + asked_->count;
  const bool swapped = log_.last_swapped() && *log_.last_swapped() + 1 >= end;
  const bool shown = swapped && log_.all_shown(asked_->first, asked_->count);
  const bool stuck = barrier_.in_flight() == 0 && std::ranges::all_of(assignment_, [&](const auto& entry) {
                       const Phase phase = members_.find(entry.first)->phase;
                       if (shares_.is_spare(entry.first)) return phase == Phase::kOut || phase == Phase::kAbsent;
                       return entry.second.empty() || phase == Phase::kOut;
                     });
  const bool failed = swapped && !asked_->error.empty();
  const bool complete = swapped && (shown || is_never_shown(now) || failed);
  if (!complete && !stuck) return;

  proto::Reply answer;
  answer.set_id(asked_->id);
  const bool is_lost = complete && !shown && !has_deadline() && asked_->error.empty();
  answer.set_error(!complete ? "every node that draws is out" : is_lost ? kDisplayIsOut : asked_->error);
  for (const proto::FrameReport& report : log_.reports(asked_->first, asked_->count)) *answer.add_frame() = report;
  reply(asked_->client, std::move(answer));
  if (!complete) pacing_.ask_for(0);
  asked_.reset();
  unshown_.clear();
  log_.nobody_wants_them();
}

}  // namespace lfd::controller
