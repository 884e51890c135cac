// Says when a warning is due that strangers could otherwise repeat at will.
#pragma once

#include <optional>

#include "base/clock.h"

namespace lfd {

class NowAndThen {
 public:
  static constexpr Clock::duration kPause = std::chrono::seconds(5);

  // At once, and then once in kPause.
  bool due(Clock::time_point now) {
    if (last_ && now - *last_ < kPause) return false;
    last_ = now;
    return true;
  }

 private:
  std::optional<Clock::time_point> last_;
};

}  // namespace lfd
