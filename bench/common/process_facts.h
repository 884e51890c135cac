// What a process holds, as /proc tells: memory and descriptors.
#pragma once

#include <optional>

namespace lfd::bench {

struct ProcessFacts {
  double resident_mib = 0;
  int descriptors = 0;
};

// Absent where there is no such process (any more).
std::optional<ProcessFacts> facts_of(int process);

// Processor time that all its threads have used, in seconds; absent likewise.
std::optional<double> processor_time_s(int process);

}  // namespace lfd::bench
