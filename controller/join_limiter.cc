// Token buckets.
#include "controller/join_limiter.h"

#include <algorithm>

namespace lfd::controller {

JoinLimiter::Bucket JoinLimiter::Bucket::refilled(Clock::time_point now, double per_second, double most) const {
  const double seconds = std::chrono::duration<double>(std::max(now - at, Clock::duration::zero())).count();
  return {std::min(tokens + per_second * seconds, most), now};
}

bool JoinLimiter::admits(const std::string& address, Clock::time_point now) {
  all_ = all_.refilled(now, kPerSecondOfAll, kBurstOfAll);
  const auto known = addresses_.find(address);
  Bucket own = known == addresses_.end() ? Bucket{kBurst, now} : known->second.refilled(now, kPerSecond, kBurst);
  if (all_.tokens < 1 || own.tokens < 1) {
    ++passed_over_;
    return false;
  }
  // A full bucket says no more than none.
  std::erase_if(addresses_,
                [&](const auto& entry) { return entry.second.refilled(now, kPerSecond, kBurst).tokens >= kBurst; });
  all_.tokens -= 1;
  own.tokens -= 1;
  addresses_[address] = own;
  return true;
}

bool JoinLimiter::tells(const std::string& peer, Clock::time_point now) {
  const auto is_past = [&](const auto& entry) { return now - entry.second >= kTellPause; };
  const auto known = told_.find(peer);
  if (known != told_.end() && !is_past(*known)) return false;
  all_told_ = all_told_.refilled(now, kPerSecondOfTold, kBurstOfTold);
  if (all_told_.tokens < 1) return false;
  all_told_.tokens -= 1;
  std::erase_if(told_, is_past);
  told_[peer] = now;
  return true;
}

bool JoinLimiter::warns(Clock::time_point now) {
  if (passed_over_ == warned_of_ || !pause_.due(now)) return false;
  warned_of_ = passed_over_;
  return true;
}

}  // namespace lfd::controller
