// Says when a warning is due that strangers could otherwise repeat at will.
#pragma once

#include <cstdint>

#include "base/clock.h"

namespace lfd {

class NowAndThen {
 public:
  static constexpr Clock::duration kPause = std::chrono::seconds(5);

  // `at_once`: how many in a row.
  explicit NowAndThen(int at_once = 1) : at_once_(at_once) {}

  // At once, and then so many in kPause.
  bool due(Clock::time_point now) {
    if (now >= next_) {
      next_ = now + kPause;
      said_ = 0;
    }
    return said_++ < at_once_;
  }

 private:
  int at_once_;
  std::int64_t said_ = 0;
  Clock::time_point next_ = Clock::time_point::min();
};

}  // namespace lfd
