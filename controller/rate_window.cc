// The window of rates.
#include "controller/rate_window.h"

#include <algorithm>

namespace lfd::controller {
namespace {

constexpr Clock::duration kWindow = std::chrono::seconds(3);

}  // namespace

void RateWindow::happened(Clock::time_point now) {
  times_.push_back(now);
  while (now - times_.front() > kWindow) times_.pop_front();
}

double RateWindow::per_second(Clock::time_point now) const {
  const auto first = std::ranges::find_if(times_, [&](Clock::time_point time) { return now - time <= kWindow; });
  const auto count = std::distance(first, times_.end());
  if (count < 2 || times_.back() == *first) return 0;
  return static_cast<double>(count - 1) / std::chrono::duration<double>(times_.back() - *first).count();
}

}  // namespace lfd::controller
