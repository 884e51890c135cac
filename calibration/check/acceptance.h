// Whether a calibration may drive a display: limits for its numbers, and which of them it misses.
#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "calibration/check/check.h"

namespace lfd {

// A calibration is accepted within these; shares are of 1, and each holds for every module.
struct AcceptanceLimits {
  double round_trip_max_px = 1e-6;
  double mirrored = 0;
  double near_singular = 0;
  double folded = 0;
  double image_unmapped = 0.5;
  double condition_max = 1e3;
  double coverage_least = 0.9;
};

// One line for each limit that is missed, with the worst module: "condition number: 2e+04 (module 3); at most 1000 is
// accepted".
std::vector<std::string> missed_limits(const CalibrationReport& report, const AcceptanceLimits& limits);

// A quick check (kQuickSampling) against the default limits; an error says all that are missed. It looks at fewer
// points than `lfd-calibrate check` does, but at every cell of a grid.
Status accept_calibration(const DisplayCalibration& display);

}  // namespace lfd
