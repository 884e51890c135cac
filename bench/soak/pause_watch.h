// The longest time without a swap. Told the time.
#pragma once

#include <algorithm>
#include <optional>

#include "base/clock.h"

namespace lfd::bench {

class PauseWatch {
 public:
  void swapped(Clock::time_point at) {
    longest_ = longest(at);
    last_ = at;
  }

  // Since the first swap, or since start_anew; a pause that goes on counts so far.
  Clock::duration longest(Clock::time_point now) const {
    return last_ ? std::max(longest_, now - *last_) : Clock::duration::zero();
  }

  // Forgets pauses that are over; the one that goes on has begun with the last swap.
  void start_anew() { longest_ = Clock::duration::zero(); }

 private:
  std::optional<Clock::time_point> last_;
  Clock::duration longest_{};
};

}  // namespace lfd::bench
