// What a soak has counted, the bounds it is judged by, and its table as text whose last line is the verdict.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/soak/faults.h"

namespace lfd::bench {

struct SoakOptions {
  double minutes = 10;
  std::optional<int> faults;  // that many, instead of so many minutes
  std::uint64_t seed = 1;
};

// How the soak's cluster is run.
inline constexpr int kFramesPerSecond = 20, kHeartbeat_ms = 100, kDeadline_ms = 250;  // begin to swap

// The bounds; beyond one of them the soak has failed.

// From the end of a fault until all draw again: a GL start on a loaded machine.
inline constexpr double kMostRecovery_s = 20;

// Between two swaps: a frame begins one interval after the one before it and swaps by its deadline. One more deadline
// is for two cores on which all nodes draw in software: the controller may not run as soon as it could. It stays below
// the six heartbeats after which a silent peer is out, so that waiting for a peer instead of the deadline is found.
inline constexpr double kMostPause_s = 1.0 / kFramesPerSecond + 2 * kDeadline_ms / 1000.0;
static_assert(kMostPause_s < 6 * kHeartbeat_ms / 1000.0);

// Likewise, less the time that the controller or the display was away, without which nothing is shown. One that was
// stopped is heard with its next heartbeat; where it was out by then it joins anew, which a second heartbeat is for.
// One that was killed starts, reads its files and is joined; nobody starts GL.
inline constexpr double kMostPauseAfterStop_s = kMostPause_s + 2 * kHeartbeat_ms / 1000.0;
inline constexpr double kMostPauseAfterStart_s = kMostPause_s + 5;

// Of a process's resident memory, from the first tenth of the faults until the last.
inline constexpr double kMostGrowth_mib = 8;

// Of one kind of fault.
double most_pause_s(Fault fault);

struct SoakTable {
  SoakOptions options;
  double took_s = 0;
  // What came of one fault.
  struct Outcome {
    Fault fault = Fault::kKillNode;
    double recovery_s = 0;  // from the end of the fault
    double pause_s = 0;     // the longest between two swaps, less the time that the controller or the display was away
  };
  std::vector<Outcome> outcomes;
  std::uint64_t shown_frames = 0;  // written by the display and looked at
  std::uint64_t late_frames = 0;   // swapped by the deadline
  std::uint64_t stale_frames = 0;  // shown with stale modules
  std::uint64_t mixed_frames = 0;  // with a module of another state than their own, not marked stale
  std::uint64_t judged_modules = 0;
  struct Growth {
    std::string process;
    double mib_then = 0, mib_now = 0;  // resident, after the first tenth of the faults and after the last
    int descriptors_then = 0, descriptors_now = 0;
  };
  std::vector<Growth> growths;      // of the processes that no fault kills in between
  std::vector<std::string> broken;  // which bound, and by what, or why the soak could not go on; empty: passed

  std::string verdict() const;                              // one line
  int exit_code() const { return broken.empty() ? 0 : 1; }  // of a program that ends with this verdict
};

// Adds every bound that the counts break to table.broken.
void judge(SoakTable& table);

std::string text_of(const SoakTable& table);

}  // namespace lfd::bench
