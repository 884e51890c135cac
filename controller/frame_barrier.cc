// Frames open and close in order.
#include "controller/frame_barrier.h"

#include "base/check.h"

namespace lfd::controller {

bool FrameBarrier::may_begin() const {
  return frames_.size() < kInFlight && (frames_.empty() || frames_.back().drawing.empty());
}

void FrameBarrier::continue_at(std::uint64_t frame) {
  LFD_CHECK(frame >= next_, "frames ascend");
  next_ = frame;
}

std::uint64_t FrameBarrier::begin(const std::vector<std::string>& nodes, Clock::time_point now) {
  LFD_CHECK(may_begin(), "a frame begins only when the barrier lets it");
  LFD_CHECK(!nodes.empty(), "a frame has somebody who draws it");
  const std::set<std::string> all(nodes.begin(), nodes.end());
  frames_.push_back({.number = next_, .begun = now, .drawing = all, .waiting = all, .ready = {}, .lost = {}});
  return next_++;
}

FrameBarrier::Frame* FrameBarrier::find(std::uint64_t frame) {
  for (Frame& open : frames_) {
    if (open.number == frame) return &open;
  }
  return nullptr;
}

void FrameBarrier::drawn(const std::string& node, std::uint64_t frame) {
  if (Frame* open = find(frame)) open->drawing.erase(node);
}

void FrameBarrier::ready(const std::string& node, std::uint64_t frame) {
  Frame* open = find(frame);
  if (open == nullptr) return;
  open->drawing.erase(node);
  if (open->waiting.erase(node) > 0) open->ready.push_back(node);
}

void FrameBarrier::failed(const std::string& node, std::uint64_t frame) {
  Frame* open = find(frame);
  if (open == nullptr) return;
  open->drawing.erase(node);
  if (open->waiting.erase(node) > 0) open->lost.push_back(node);
}

void FrameBarrier::gone(const std::string& node) {
  for (Frame& open : frames_) {
    open.drawing.erase(node);
    if (open.waiting.erase(node) > 0) open.lost.push_back(node);
  }
}

std::optional<FrameBarrier::Swap> FrameBarrier::swap(Clock::time_point now) {
  if (frames_.empty()) return std::nullopt;
  Frame& oldest = frames_.front();
  const bool whole = oldest.waiting.empty();
  const bool late = deadline_ > Clock::duration::zero() && now - oldest.begun >= deadline_;
  if (!whole && !late) return std::nullopt;
  Swap swap{.frame = oldest.number,
            .ready = std::move(oldest.ready),
            .missing = std::move(oldest.lost),
            .late = !whole,
            .begun = oldest.begun};
  swap.missing.insert(swap.missing.end(), oldest.waiting.begin(), oldest.waiting.end());
  frames_.pop_front();
  return swap;
}

std::optional<Clock::time_point> FrameBarrier::next_deadline() const {
  if (frames_.empty() || deadline_ == Clock::duration::zero()) return std::nullopt;
  return frames_.front().begun + deadline_;
}

std::vector<FrameBarrier::Waiting> FrameBarrier::waiting_since(Clock::time_point then) const {
  std::vector<Waiting> all;
  for (const Frame& frame : frames_) {
    if (frame.begun <= then && !frame.waiting.empty())
      all.push_back({frame.number, {frame.waiting.begin(), frame.waiting.end()}});
  }
  return all;
}

}  // namespace lfd::controller
