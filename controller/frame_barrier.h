// When frames begin and swap: in order, at most kInFlight at once, whole or at the deadline. Told events and the time.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/clock.h"

namespace lfd::controller {

class FrameBarrier {
 public:
  static constexpr std::size_t kInFlight = 2;  // one is drawn while the one before it travels

  // `deadline` runs from begin to swap; zero: every node is waited for.
  explicit FrameBarrier(Clock::duration deadline) : deadline_(deadline) {}

  // Fewer than kInFlight frames are open, and the newest is drawn by all its nodes.
  bool may_begin() const;

  // The next frame has this number, which is not below that of the frame that would be the next.
  void continue_at(std::uint64_t frame);

  // Opens the next frame for `nodes` (at least one) and returns its number; frames count from 0 unless they continue
  // elsewhere. may_begin() is true.
  std::uint64_t begin(const std::vector<std::string>& nodes, Clock::time_point now);

  // Events of nodes. What concerns no open frame (it swapped without the node) has no effect. Ready includes drawn.
  void drawn(const std::string& node, std::uint64_t frame);
  void ready(const std::string& node, std::uint64_t frame);
  // The node could not draw the frame, which waits for it no longer: it is missing there.
  void failed(const std::string& node, std::uint64_t frame);

  // The node died, left or joined anew: no open frame waits for it any more, and it is missing in those it was not
  // ready for.
  void gone(const std::string& node);

  struct Swap {
    std::uint64_t frame = 0;
    std::vector<std::string> ready;    // nodes whose images are in it
    std::vector<std::string> missing;  // nodes that took part and were not ready: their modules are stale
    bool late = false;                 // the deadline decided
    Clock::time_point begun;
  };

  // The oldest open frame, closed, if all its nodes are ready or its deadline has passed. Call until absent.
  std::optional<Swap> swap(Clock::time_point now);

  // When swap() is to be asked again though nothing happens.
  std::optional<Clock::time_point> next_deadline() const;

  struct Waiting {
    std::uint64_t frame = 0;
    std::vector<std::string> nodes;  // that have not said ready
  };
  // Of the open frames that began then or earlier: whom they wait for. The oldest first.
  std::vector<Waiting> waiting_since(Clock::time_point then) const;

  std::size_t in_flight() const { return frames_.size(); }
  std::uint64_t next_frame() const { return next_; }

 private:
  struct Frame {
    std::uint64_t number;
    Clock::time_point begun;
    std::set<std::string> drawing;  // have not said drawn
    std::set<std::string> waiting;  // have not said ready
    std::vector<std::string> ready;
    std::vector<std::string> lost;  // gone before they were ready
  };
  Frame* find(std::uint64_t frame);

  Clock::duration deadline_;
  std::deque<Frame> frames_;  // the oldest first
  std::uint64_t next_ = 0;
};

}  // namespace lfd::controller
