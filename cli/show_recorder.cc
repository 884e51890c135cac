// Published messages to recorded events.
#include "cli/show_recorder.h"

#include <algorithm>
#include <utility>

#include "base/log.h"

namespace lfd {
namespace {

constexpr std::size_t kMostOpen = 256;  // swaps of older frames were lost

// The sequence that a message of the state channel names; absent where it names none.
std::optional<std::uint64_t> sequence_of(const proto::Envelope& message) {
  if (message.has_update()) return message.update().sequence();
  if (message.has_begin()) return message.begin().sequence();
  if (message.has_pulse()) return message.pulse().sequence();
  return std::nullopt;
}

}  // namespace

// A controller that was started anew counts from the beginning; one that says which life it is in need not have got
// further for that.
bool ShowRecorder::is_of_another_life(const proto::Envelope& message) {
  if (message.session() != 0) {
    if (session_ != 0 && session_ != message.session()) return true;
    session_ = message.session();
  }
  if (const auto sequence = sequence_of(message)) {
    if (*sequence < heard_sequence_) return true;
    heard_sequence_ = *sequence;
  }
  if (!message.has_begin()) return false;
  if (heard_frame_ && message.begin().frame() <= *heard_frame_) return true;
  heard_frame_ = message.begin().frame();
  return false;
}

void ShowRecorder::heard(const proto::Envelope& message, Clock::time_point now) {
  if (end_) return;
  if (message.has_quit()) {
    end_ = End{.reason = fmt::format("the controller ended: {}", message.quit().reason()), .is_fault = false};
    return;
  }
  if (message.begin().again() || message.swap().again()) return;
  if (is_of_another_life(message)) {
    end_ = End{.reason = "the controller was started anew, which is another show", .is_fault = true};
    return;
  }
  if (message.has_pulse()) hears_ = true;
  if (!hears_) return;
  if (waits_) {
    wait_with(message, now);
  } else {
    take(message, now);
  }
}

void ShowRecorder::wait_with(const proto::Envelope& message, Clock::time_point at) {
  waits_ = true;
  waiting_.push_back({message, at, message.ByteSizeLong()});
  waiting_bytes_ += waiting_.back().bytes;
  while (waiting_.size() > kMostWaiting || waiting_bytes_ > kMostWaiting_bytes) {
    waiting_bytes_ -= waiting_.front().bytes;
    waiting_.pop_front();
  }
}

void ShowRecorder::want_assets() {
  const proto::Scene& scene = follower_.state()->scene();
  gatherer_.want(scene);
  named_.merge(asset_hashes(scene));
}

void ShowRecorder::snapshot_came(const proto::State& state, Clock::time_point now) {
  if (!waits_ || end_) return;
  waits_ = false;
  follower_.snapshot_came(state);
  ++snapshots_;
  const Clock::time_point at = waiting_.empty() ? now : waiting_.front().at;
  if (!started_) started_ = at;
  proto::RecordingEvent event;
  *event.mutable_snapshot() = *follower_.state();
  record(std::move(event), at);
  want_assets();
  waiting_bytes_ = 0;
  // One of them may open another gap: those after it wait again.
  for (const Heard& one : std::exchange(waiting_, {})) {
    if (waits_) {
      wait_with(one.message, one.at);
    } else {
      take(one.message, one.at);
    }
  }
}

void ShowRecorder::take(const proto::Envelope& message, Clock::time_point at) {
  if (has_enough()) return;
  switch (message.body_case()) {
    case proto::Envelope::kUpdate:
      return take_update(message.update(), at);
    case proto::Envelope::kBegin:
      return take_begin(message.begin(), at);
    case proto::Envelope::kPulse:
      follower_.pulse_came(message.pulse().sequence());
      if (follower_.has_gap()) waits_ = true;
      return;
    case proto::Envelope::kSwap: {
      const bool is_open = open_.contains(message.swap().frame());
      open_.erase(open_.begin(), open_.upper_bound(message.swap().frame()));  // in order: earlier ones were lost
      if (!is_open) return;
      ++swapped_;
      proto::RecordingEvent event;
      *event.mutable_swap() = message.swap();
      return record(std::move(event), at);
    }
    default:
      return;
  }
}

void ShowRecorder::take_update(const proto::Update& update, Clock::time_point at) {
  const std::uint64_t before = follower_.sequence();
  follower_.update_came(update);
  if (follower_.has_gap()) {
    proto::Envelope again;
    *again.mutable_update() = update;
    return wait_with(again, at);
  }
  if (follower_.sequence() == before) return;  // the snapshot has it
  proto::RecordingEvent event;
  *event.mutable_update() = update;
  event.mutable_update()->clear_images_endpoint();
  record(std::move(event), at);
  if (names_assets(update)) want_assets();  // what turns inside out is another mesh
}

// A frame of a state that was passed over with a snapshot cannot be drawn again.
void ShowRecorder::take_begin(const proto::BeginFrame& begin, Clock::time_point at) {
  follower_.pulse_came(begin.sequence());
  if (follower_.has_gap()) {
    proto::Envelope again;
    *again.mutable_begin() = begin;
    return wait_with(again, at);
  }
  if (most_frames_ && swapped_ + open_.size() >= *most_frames_) return;
  if (begin.sequence() != follower_.sequence()) {
    if (snapshots_ > 1) ++left_out_;  // before the first one the recording has not begun
    return;
  }
  proto::RecordingEvent event;
  event.mutable_begin()->set_frame(begin.frame());
  event.mutable_begin()->set_state_hash(follower_.hash());
  record(std::move(event), at);
  ++begun_;
  open_.insert(begin.frame());
  if (open_.size() > kMostOpen) open_.erase(open_.begin());
}

void ShowRecorder::record(proto::RecordingEvent event, Clock::time_point at) {
  const auto since = std::chrono::duration_cast<std::chrono::nanoseconds>(at - *started_).count();
  last_nanoseconds_ = std::max(last_nanoseconds_, static_cast<std::uint64_t>(std::max<std::int64_t>(since, 0)));
  event.set_nanoseconds(last_nanoseconds_);
  events_.push_back(std::move(event));
}

std::vector<proto::RecordingEvent> ShowRecorder::take_events() { return std::exchange(events_, {}); }

std::vector<ShowRecorder::Asset> ShowRecorder::take_assets() {
  std::vector<Asset> assets;
  for (const auto& [hash, content] : gatherer_.assets()) {
    if (written_.insert(hash).second) assets.push_back({hash, content});
  }
  return assets;
}

}  // namespace lfd
