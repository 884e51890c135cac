// How often something happened in the last seconds.
#pragma once

#include <deque>

#include "base/clock.h"

namespace lfd::controller {

class RateWindow {
 public:
  void happened(Clock::time_point now);

  // Per second, of what happened in the last seconds; 0 where that was at fewer than two times.
  double per_second(Clock::time_point now) const;

 private:
  std::deque<Clock::time_point> times_;
};

}  // namespace lfd::controller
