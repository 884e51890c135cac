// The global optimisation: the pinholes of all modules and the screen's radius, from all observations at once.
#pragma once

#include <span>
#include <vector>

#include "base/result.h"
#include "calibration/fit/check_input.h"
#include "calibration/fit/pinhole_family.h"

namespace lfd {

// The least sum, over all observations, of Cauchy's loss of (seen - projected) / (scale sigma), plus the squares of all
// parameters in units of their standard deviations: the prior, which decides what observations of a plane cannot
// (of a pinhole's position, focal lengths and principal point, two combinations leave its picture as it is).
struct PinholeFit {
  std::vector<PinholeVector> z;  // of each module's family
  std::vector<double> scale;     // of each module: its residuals' robust standard deviation, in sigmas
  double curvature = 0;          // 1 / screen radius, 1/m
  double curvature_change = 0;   // log(curvature / start) in standard deviations
};

inline constexpr double kCurvatureSd = 0.2;  // of the logarithm of a curved screen's curvature
inline constexpr double kLossWidth = 3;      // of Cauchy's loss, in scaled sigmas

// The scale where sigmas are to be found from the observations themselves, px: as if nothing were measured better.
inline constexpr double kLeastScale_px = 1e-7;

// Whether the curvature is fitted with the pinholes, or stays the start's.
enum class Curvature { kFitted, kHeld };

// `sigmas_are_known`: scales are at least 1, more where pinholes cannot represent what was seen. A planar screen
// (start_curvature 0) stays planar. Errors: a module whose start does not see an observation; no convergence.
Result<PinholeFit> fit_pinholes(std::span<const PinholeFamily> families, std::span<const ModuleObservations> modules,
                                double start_curvature, Curvature curvature, bool sigmas_are_known);

// Where the fitted pinhole sees the observation's screen point, minus where it was seen, px. Absent behind it.
std::optional<glm::dvec2> pinhole_residual(const PinholeFamily& family, const PinholeVector& z, double curvature,
                                           const Observation& observation);

// Standard deviation along an axis of points with normal errors, by the median of their distances.
double robust_spread(std::vector<double> distances);

}  // namespace lfd
