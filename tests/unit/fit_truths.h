// Truths of fits: what observations of them are made, and how far a fitted map is from them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "calibration/fit/fit.h"
#include "calibration/fit/simulate.h"

namespace lfd {

inline constexpr double kNoise_px = 0.1;

// Few points for each module, so that the tests are short and the task is not too easy.
inline SimulationOptions few_points() {
  SimulationOptions options;
  options.noise_px = kNoise_px;
  options.outliers = 0;
  options.missing = 0;
  options.points_u = 20;
  options.points_v = 15;
  return options;
}

// Of a fitted map in the image, px.
struct MapError {
  double root_mean_square_px = 0, quantile_98_px = 0, max_px = 0;
};

inline MapError map_error_of(std::vector<double> distances) {
  std::ranges::sort(distances);
  double squares = 0;
  for (const double distance : distances) squares += distance * distance;
  return {std::sqrt(squares / static_cast<double>(distances.size())), distances[distances.size() * 98 / 100],
          distances.back()};
}

inline double nearest_px(const Observations& observations, int module, PixelPoint p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Observation& seen : observations.points) {
    if (seen.module == module) nearest = std::min(nearest, std::hypot(seen.in_image.x - p.x, seen.in_image.y - p.y));
  }
  return nearest;
}

// Over an even raster of held-out points (no point of the simulation is one) of one module. Points of the image that
// the truth shows on the screen must be answered; the border within 3 px may be beside the fitted screen or image by
// the error alone. With `observations`, only points within so many px of one count.
inline std::vector<double> map_distances(const DisplayCalibration& truth, const DisplayCalibration& fitted,
                                         std::size_t k, const Observations* observations = nullptr,
                                         double within_px = 0) {
  std::vector<double> distances;
  for (double v = 3; v < truth.image.height - 3; v += 6.1) {
    for (double u = 3; u < truth.image.width - 3; u += 6.1) {
      const auto s = screen_from_image(truth, truth.modules[k], {u, v});
      if (!s || (observations && nearest_px(*observations, static_cast<int>(k), {u, v}) > within_px)) continue;
      const auto p = image_from_screen(fitted, fitted.modules[k], *s);
      EXPECT_TRUE(p) << "module " << k << " at " << u << " " << v;
      if (p) distances.push_back(std::hypot(p->x - u, p->y - v));
    }
  }
  return distances;
}

// Of all modules.
inline MapError map_error(const DisplayCalibration& truth, const DisplayCalibration& fitted) {
  std::vector<double> distances;
  for (std::size_t k = 0; k < truth.modules.size(); ++k) {
    const std::vector<double> more = map_distances(truth, fitted, k);
    distances.insert(distances.end(), more.begin(), more.end());
  }
  return map_error_of(std::move(distances));
}

// Pinholes keep the bound, 1.5 times the noise, also at the point that is recovered worst, seen or not.
inline void expect_recovered(const DisplayCalibration& truth, const FittedDisplay& fitted) {
  const MapError error = map_error(truth, fitted.display);
  EXPECT_LE(error.max_px, 1.5 * kNoise_px);
  // 15 parameters from 600 numbers: sqrt(15 / 600) of the noise along each axis, were all as well known.
  EXPECT_LE(error.root_mean_square_px, 0.4 * kNoise_px);
}

// What fit.h promises of grids, for every module: a field of many parameters follows the few observations in a corner,
// and goes on from them to the border, where single points are as far off as single observations are.
inline void expect_grids_recovered(const DisplayCalibration& truth, const FittedDisplay& fitted,
                                   const Observations& observations) {
  for (std::size_t k = 0; k < truth.modules.size(); ++k) {
    SCOPED_TRACE(k);
    const double spacing_px = truth.image.width / 24.0;  // of 24 x 18 observations
    const MapError error = map_error_of(map_distances(truth, fitted.display, k, &observations, spacing_px));
    EXPECT_LE(error.root_mean_square_px, 0.7 * kNoise_px);
    EXPECT_LE(error.quantile_98_px, 1.5 * kNoise_px);
    EXPECT_LE(error.max_px, 4 * kNoise_px);
  }
}

inline std::vector<std::size_t> lines_of(const std::vector<Outlier>& outliers) {
  std::vector<std::size_t> lines;
  for (const Outlier& outlier : outliers) lines.push_back(outlier.line);
  return lines;
}

inline std::vector<std::size_t> outlier_lines(const SimulatedObservations& simulated) {
  std::vector<std::size_t> lines;
  for (const std::size_t i : simulated.outliers) lines.push_back(simulated.observations.points[i].line);
  return lines;
}

}  // namespace lfd
