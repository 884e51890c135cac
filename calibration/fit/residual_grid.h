// A fitted pinhole with its residual field, as a grid of nodes.
#pragma once

#include <optional>

#include "calibration/fit/pinhole_family.h"
#include "calibration/fit/residual_field.h"
#include "calibration/maps/grid.h"

namespace lfd {

struct FittedPinhole {
  const PinholeFamily& family;
  const PinholeVector& z;
  double curvature = 0;  // of the screen, 1/m
};

// The point of the screen that the pinhole sees at p, by solving. Absent where there is none.
std::optional<ScreenPoint> screen_from_image(const FittedPinhole& fitted, PixelPoint p);

// Node at p: the point of the screen that the pinhole sees at p + field(p). The grid reaches one node beyond the image
// on every side; its nodes are as close as it takes for the middles of its cells to be within tolerance_px, but at most
// 256 intervals a side. Absent where such a grid folds or cannot be.
std::optional<GridMap> residual_grid(const FittedPinhole& fitted, const ResidualField& field, ImageSize image,
                                     double tolerance_px);

}  // namespace lfd
