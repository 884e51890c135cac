// The one clock of every process: monotonic, never set back.
#pragma once

#include <chrono>

namespace lfd {

using Clock = std::chrono::steady_clock;

inline double milliseconds(Clock::duration duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

}  // namespace lfd
