// Decides how many joins are looked at: a join is answered with a whole scene, which a flood of them must not multiply.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "base/clock.h"
#include "base/now_and_then.h"

namespace lfd::controller {

class JoinLimiter {
 public:
  // Joins at once, and a second from then on; of one address and of all together.
  static constexpr double kBurst = 10, kPerSecond = 5;
  static constexpr double kBurstOfAll = 256, kPerSecondOfAll = 128;

  // Whether a join that comes now is looked at. `address`: whoever is to be limited: a member, else a connection.
  bool admits(const std::string& address, Clock::time_point now);

  std::uint64_t passed_over() const { return passed_over_; }

  // Whether a peer whose join was passed over is told so now: once in kTellPause, and only so many of all together, so
  // that a flood is not answered by a flood. `peer`: its connection.
  bool tells(const std::string& peer, Clock::time_point now);
  static constexpr std::chrono::milliseconds kTellPause{1000};
  static constexpr double kBurstOfTold = 64, kPerSecondOfTold = 32;

  // Whether there is something to warn of: joins were passed over since the last time, which was not just now.
  bool warns(Clock::time_point now);

  // Addresses that are remembered: at most those that were admitted within kBurst / kPerSecond seconds, 512 or so.
  std::size_t remembered() const { return addresses_.size(); }
  // Peers that were told within kTellPause: at most kBurstOfTold and those of one pause more.
  std::size_t remembered_told() const { return told_.size(); }

 private:
  // Tokens that come back with time.
  struct Bucket {
    double tokens = 0;
    Clock::time_point at;

    Bucket refilled(Clock::time_point now, double per_second, double most) const;
  };

  Bucket all_{kBurstOfAll, {}}, all_told_{kBurstOfTold, {}};
  std::map<std::string, Bucket> addresses_;  // those that are not full
  std::map<std::string, Clock::time_point> told_;
  std::uint64_t passed_over_ = 0, warned_of_ = 0;
  NowAndThen pause_;
};

}  // namespace lfd::controller
