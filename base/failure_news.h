// Says which failures of something that is done all the time are worth a line in the log, and when it works again.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "base/clock.h"

namespace lfd {

// At most a line for each cause, and one that it works again, within kQuiet: also where it works and fails by turns.
class FailureNews {
 public:
  static constexpr Clock::duration kQuiet = std::chrono::seconds(5);  // without a failure: it works again
  static constexpr std::size_t kMostCauses = 8;                       // that are told apart

  // It has failed; whether that is news: the first time for this cause since it last worked.
  bool failed(const std::string& cause, Clock::time_point now) {
    last_failure_ = now;
    ++failures_;
    return causes_.size() < kMostCauses && causes_.insert(cause).second;
  }

  // It has worked. Where that is news: how many have failed before.
  std::optional<std::uint64_t> worked(Clock::time_point now) {
    if (failures_ == 0 || now - last_failure_ < kQuiet) return std::nullopt;
    causes_.clear();
    return std::exchange(failures_, 0);
  }

 private:
  std::set<std::string> causes_;  // since it last worked
  std::uint64_t failures_ = 0;    // likewise
  Clock::time_point last_failure_{};
};

}  // namespace lfd
