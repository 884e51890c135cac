// A cluster that runs while one fault after the other befalls it: what was shown, how soon it was whole again, and what
// the processes that lived through it all had grown by.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/signals.h"
#include "bench/soak/faults.h"

namespace lfd::bench {

struct SoakOptions {
  double minutes = 10;
  std::optional<int> faults;  // that many, instead of so many minutes
  std::uint64_t seed = 1;
};

// The bounds; beyond one of them the soak has failed.
inline constexpr double kMostRecovery_s =
    20;  // from the end of a fault until all draw again: a GL start on a loaded machine
inline constexpr double kMostGrowth_mib = 8;  // of a process, from the first tenth of the faults on

struct SoakTable {
  SoakOptions options;
  double took_s = 0;
  struct Recovery {
    Fault fault = Fault::kKillNode;
    double seconds = 0;  // from the end of the fault
  };
  std::vector<Recovery> recoveries;  // one for each fault
  std::uint64_t shown_frames = 0;    // written by the display and looked at
  std::uint64_t late_frames = 0;     // swapped by the deadline
  std::uint64_t stale_frames = 0;    // shown with stale modules
  std::uint64_t mixed_frames = 0;    // with a module of another state than their own, not marked stale
  std::uint64_t judged_modules = 0;
  double longest_pause_s = 0;  // between two swaps, while controller and display were up
  struct Growth {
    std::string process;
    double mib_then = 0, mib_now = 0;  // resident, after the first tenth of the faults and after the last gentle one
    int descriptors_then = 0, descriptors_now = 0;
  };
  std::vector<Growth> growths;
  std::vector<std::string> broken;  // which bound, and by what; empty: passed

  std::string verdict() const;  // one line
};

// Runs in a temporary folder on free ports of the loopback interface, with the programs beside this one. Errors: it
// could not be run at all, or was ended by a signal.
Result<SoakTable> soak(const SoakOptions& options, StopSignals& signals,
                       const std::function<void(const std::string& line)>& progress);

std::string text_of(const SoakTable& table);

}  // namespace lfd::bench
