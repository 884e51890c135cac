// What a pinhole misses, as a smooth displacement of the image: a smoothing spline, its smoothness by cross-validation.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

#include "calibration/spaces/pixel.h"

namespace lfd {

// Uniform bicubic B-spline of displacements in px over the image, one interval wider on every side.
struct ResidualField {
  int columns = 0, rows = 0;  // control points, 3 more than intervals
  glm::dvec2 first_px{0};     // where the first interval begins
  glm::dvec2 step_px{1};      // of an interval
  std::vector<glm::dvec2> control;

  // Beyond the last intervals these go on as cubics.
  glm::dvec2 at(PixelPoint p) const;
};

struct SmoothedResiduals {
  ResidualField field;
  // Root mean square distance, over points that were held out of the smoothing, px, by Cauchy's weights.
  double held_out_without_px = 0, held_out_with_px = 0;
  double held_out_spread = 0;  // with the field: robust standard deviation along an axis, in the samples' sigmas
  // Whether the field explains held-out points better, by more than chance (3 standard errors) and by 1 %.
  bool is_better = false;
};

struct ResidualSample {
  PixelPoint at;
  glm::dvec2 residual_px;
  double sigma_px = 1;  // relative among samples
};

// The spline with the least sum of Cauchy's loss of the differences, scaled by sigma and by their robust spread, plus
// lambda times the squared third differences of its control points; of a ladder of lambdas the one with the least
// residuals held out in five parts. The order of the samples decides the parts: every fifth belongs together. Absent
// for fewer than 20 samples.
std::optional<SmoothedResiduals> smooth_residuals(ImageSize image, std::span<const ResidualSample> samples);

}  // namespace lfd
