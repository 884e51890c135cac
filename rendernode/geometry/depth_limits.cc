// Limits in z.
#include "rendernode/geometry/depth_limits.h"

#include <algorithm>
#include <limits>

namespace lfd {
namespace {

// convergence() of a conical diffuser is smooth and has at most a few extrema over the rows: a fine scan finds them.
constexpr int kRows = 65;

template <class Visit>
void for_rows(const DisplayCalibration& display, Visit visit) {
  for (const auto& module : display.modules) {
    for (int i = 0; i < kRows; ++i)
      visit(module, display.screen.height_m * (static_cast<double>(i) / (kRows - 1) - 0.5));
  }
}

}  // namespace

DepthLimits depth_limits(const DisplayCalibration& display, const RenderSettings& settings) {
  const double vz = display.optics.observer_distance_m;
  double singular = -std::numeric_limits<double>::infinity();
  for_rows(display, [&](const ModuleCalibration& module, double sy) {
    singular = std::max(singular, nearest_singular_z(display.optics, module.emitter, sy));
  });
  DepthLimits limits;
  limits.front = std::min(settings.near_z_m.value_or(0.9 * vz), 0.999 * vz);
  limits.back = std::max(settings.far_z_m.value_or(0.95 * singular), 0.999 * singular);
  // Kept apart even where the deployment asks for limits outside of what can be shown.
  limits.back = std::min(limits.back, limits.front - 1e-6 * vz);
  double least_w = std::numeric_limits<double>::infinity();
  for_rows(display, [&](const ModuleCalibration& module, double sy) {
    least_w = std::min(least_w, 1 + convergence(display.optics, module.emitter, sy) * limits.back / vz);
  });
  limits.depth_scale = std::max(least_w, 1e-9) / (limits.front - limits.back);
  return limits;
}

}  // namespace lfd
