// The numbers with which a calibration is accepted (design geometry, section 3).
#pragma once

#include <optional>
#include <vector>

#include "calibration/check/angles.h"
#include "calibration/check/depth_budget.h"
#include "calibration/display.h"

namespace lfd {

// An axis-aligned box of physical space, as a region of interest has one; edge lengths in metres, > 0.
struct PhysicalBox {
  Point3<Physical> centre;
  glm::dvec3 size{1.0};
};

// Where a check looks: points evenly over every image and over the screen, and over a box of physical space, in which
// the condition number is taken: `roi`, or else the screen and half_depth_m before and behind its surface.
struct CheckSampling {
  int image_columns = 48, image_rows = 36;
  int screen_columns = 65, screen_rows = 49;
  int box_points = 9;  // along each axis
  std::optional<PhysicalBox> roi = std::nullopt;
};
inline constexpr CheckSampling kThoroughSampling{};
// Some 1600 evaluations of the map per module: 64 measured grids take about 0.15 s on one core.
inline constexpr CheckSampling kQuickSampling{12, 9, 17, 13, 5};

// Of one module, or of all together. 0 where there was nothing to measure.
struct MapNumbers {
  // Distance between a point of the image and image_from_screen(screen_from_image(point)), over all points that are on
  // the screen; infinite where there is no way back. 999: the 99.9 % quantile.
  double round_trip_median_px = 0, round_trip_999_px = 0, round_trip_max_px = 0;
  double image_on_screen = 0;  // share of image points that have a screen point; the rest lights no screen
  // Share of those for which the map alone has no answer (holes, folds, beside a grid), or whose light does not reach
  // the observers from a curved screen.
  double image_unmapped = 0;
  // Shares of the points on the screen at which the map, measured against the ideal one, mirrors, or squeezes one
  // direction 1000 times more than another.
  double mirrored = 0, near_singular = 0;
  // Grid maps: share of cells that have folded anywhere in them, which bounds prove and not samples, and of those that
  // lack a corner (GridMap); 0 for other maps.
  double folded = 0, incomplete = 0;
  // condition_number() of derivative_by_physical() over the box, where there is an image.
  double condition_median = 0, condition_99 = 0, condition_max = 0;
  double coverage = 0;  // share of the screen that the module lights toward the observers; of all: their mean
};

struct CalibrationReport {
  CheckSampling sampling;
  double half_depth_m = 0;  // of the box around the screen
  MapNumbers all;
  std::vector<MapNumbers> modules;
  double coverage_any = 0;   // share of the screen lit by at least one module
  std::vector<int> lit_by;   // how many modules light each of the screen_columns x screen_rows places, from bottom left
  double pixel_width_m = 0;  // on the screen, the median over modules and places; 0 where nothing is lit
  AngularReport angles;
  // With the width of a pixel and the median angle between neighbours, seen from the centre; with one module, with
  // angular scattering / 1.5.
  std::optional<DepthBudget> depth;

  // The module with the largest value of a field, the first of equals.
  int worst_by(double MapNumbers::*field) const;
  int least_covering() const;
};

// A quarter of the screen's width, and at most half the way to the nearest emitter and to the observers.
double default_half_depth_m(const DisplayCalibration& display);

// `display` is valid, half_depth_m > 0.
CalibrationReport check_calibration(const DisplayCalibration& display, double half_depth_m,
                                    const CheckSampling& sampling = kThoroughSampling);

// The middle of a place of the screen, and of a place of the image, as sampled.
ScreenPoint sampled_screen_point(const DisplayCalibration& display, const CheckSampling& sampling, int column, int row);
PixelPoint sampled_pixel(const DisplayCalibration& display, const CheckSampling& sampling, int column, int row);

}  // namespace lfd
