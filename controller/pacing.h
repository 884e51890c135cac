// Whether the time for another frame has come: free running, a number of frames that somebody asked for, or rest.
#pragma once

#include <cstdint>
#include <optional>

#include "base/clock.h"

namespace lfd::controller {

class Pacing {
 public:
  // frames_per_second 0: as fast as the nodes draw. `idle`: at rest until frames are asked for.
  Pacing(double frames_per_second, bool idle);

  // `count` more frames, without a pace, then rest.
  void ask_for(std::uint64_t count);

  // Whether a frame is wanted at all (now or later).
  bool wants_frames() const { return !remaining_ || *remaining_ > 0; }

  // Whether a frame is due. True: begin one and say begun().
  bool due(Clock::time_point now) const;
  void begun(Clock::time_point now);

  // When due() is to be asked again though nothing happens.
  std::optional<Clock::time_point> next() const;

 private:
  bool paced() const { return !remaining_ && interval_ > Clock::duration::zero(); }

  Clock::duration interval_;                // zero: without a pace
  std::optional<std::uint64_t> remaining_;  // absent: free running
  std::optional<Clock::time_point> next_;
};

}  // namespace lfd::controller
