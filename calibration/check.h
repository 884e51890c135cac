// The numbers with which a calibration is accepted (design geometry, section 3).
#pragma once

#include <string>
#include <vector>

#include "calibration/display.h"

namespace lfd {

// Over a grid of points in every module's image, on the screen and in a box of physical space.
struct CalibrationReport {
  // Distance between a point of the image and image_from_screen(screen_from_image(point)), over all points that are on
  // the screen.
  double round_trip_median_px = 0, round_trip_999_px = 0, round_trip_max_px = 0;  // 999: the 99.9 % quantile
  double image_on_screen = 0;  // share of image points that have a screen point; the rest lights no screen
  // Shares of those points at which the map, measured against the ideal one, mirrors, or squeezes one direction 1000
  // times more than another.
  double mirrored = 0, near_singular = 0;
  // Condition number (Frobenius, 1 for the ideal map at z = 0) of d(image)/d(physical) with the image scaled to metres
  // on the screen, over the box of the screen and z = +-half_depth_m, where there is an image.
  double half_depth_m = 0;
  double condition_median = 0, condition_max = 0;
  double coverage_mean = 0;   // share of the screen that a module lights, over modules
  double coverage_least = 0;  // of the module that lights least
  int coverage_least_module = 0;
  double coverage_any = 0;  // share of the screen lit by at least one module
};

// Half depth of the box where none is asked for.
double default_half_depth_m(const DisplayCalibration& display);

// `display` is valid.
CalibrationReport check_calibration(const DisplayCalibration& display, double half_depth_m);

// A calibration is accepted within these.
struct AcceptanceLimits {
  double round_trip_max_px = 1e-6;
  double mirrored = 0, near_singular = 0;
  double condition_max = 1e3;
  double coverage_least = 0.9;
};

// One line for each limit that is missed: "round trip: max 0.3 px; at most 1e-06".
std::vector<std::string> missed_limits(const CalibrationReport& report, const AcceptanceLimits& limits);

}  // namespace lfd
