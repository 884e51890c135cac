// Whether a calibration may drive a display: limits for its numbers, and which of them it misses.
#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "calibration/check/check.h"

namespace lfd {

// A calibration is accepted within these; shares are of 1, and those of maps hold for every module. Infinity (0 for
// what has a least value) asks for nothing.
struct AcceptanceLimits {
  double round_trip_max_px = 1e-6;
  double mirrored = 0;
  double near_singular = 0;
  double folded = 0;
  // Of the image, as sampled, and of a grid's cells. Holes that lie on the screen are limited by coverage as well;
  // beside it nothing is measured, so that an image which is larger than the screen has holes at its border.
  double image_unmapped = 0.25, incomplete = 0.25;
  double condition_max = 1e3;
  double coverage_least = 0.9;
  // AngularReport::gap_over_scattering. By the rule of thumb it is 2/3, and 4/3 where a module is missing; known
  // displays with sparse emitters have 1.12.
  double gap_over_scattering = 1.25;
  // DepthBudget::doubled_at_m, metres. How deep a display must show is asked of its design (pixels and modules), not
  // of a calibration: nothing by default.
  double depth_least_m = 0;
};

// One line for each limit that is missed, with the worst module: "condition number: 2e+04 (module 3); at most 1000 is
// accepted".
std::vector<std::string> missed_limits(const CalibrationReport& report, const AcceptanceLimits& limits);

// A quick check (kQuickSampling) against the default limits; an error says all that are missed. It looks at fewer
// points than `lfd-calibrate check` does, but at every cell of a grid. The condition number is taken around the screen,
// not in a deployment's region of interest: that follows from the bounds of a scene, which is loaded after a controller
// has accepted its display, and moves on request.
Status accept_calibration(const DisplayCalibration& display);

}  // namespace lfd
