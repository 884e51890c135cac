// The stability suite: the driver at its numerical edges, case by case, with what must come out stated beforehand.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/stability/case.h"

namespace lfd::bench {

// All cases, in the order of the table: those of one group lie together, groups in the order of their first case.
StabilityCases stability_cases();

struct StabilityRow {
  std::string group, name, expected;
  Outcome outcome;
};

struct StabilityTable {
  std::string renderer;  // driver and device
  std::string version;
  std::vector<StabilityRow> rows;

  // Names of the cases that missed, "group: name".
  std::vector<std::string> missed() const;
};

// Runs all cases with a context of its own; progress goes to the log. gpu: of `lfd-rendernode --list-gpus`, -1: the
// first that works. Errors: no context.
Result<StabilityTable> run_stability(int gpu);

// One line: that all cases came out, or which did not.
std::string verdict_of(const StabilityTable& table);

// The table; its last line is the verdict.
std::string text_of(const StabilityTable& table);
std::string csv_of(const StabilityTable& table);
std::string json_of(const StabilityTable& table);

}  // namespace lfd::bench
