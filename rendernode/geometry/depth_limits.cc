// Limits in depth and in space.
#include "rendernode/geometry/depth_limits.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

namespace lfd {
namespace {

// Sides of the screen. The depth that is written has single precision at the size of the front limit: with this, steps
// of 1e-4 of the screen are told apart there, however far away the observers are.
constexpr double kMostFront = 500;

// Singular depths are smooth over the screen, with at most a few extrema: a fine scan finds them. On a planar screen
// they depend on the height alone, on a curved one on the arc length alone.
constexpr int kPlaces = 65;

template <class Visit>
void for_places(const DisplayCalibration& display, Visit visit) {
  for (const auto& module : display.modules) {
    for (int i = 0; i < kPlaces; ++i) {
      const double share = static_cast<double>(i) / (kPlaces - 1) - 0.5;
      const ScreenPoint s = display.optics.screen_radius_m == 0 ? ScreenPoint{0, share * display.screen.height_m}
                                                                : ScreenPoint{share * display.screen.width_m, 0};
      if (const auto line = line_of_screen_point(display.optics, module.emitter, s)) visit(module, s, *line);
    }
  }
}

// Lines are straight: the ends of those at the screen's borders bound all of them.
void bound_space(const DisplayCalibration& display, DepthLimits& limits) {
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const auto& module : display.modules) {
    for (int i = 0; i < kPlaces; ++i) {
      const double share = static_cast<double>(i) / (kPlaces - 1) - 0.5;
      for (const glm::dvec2& at : {glm::dvec2(share, -0.5), {share, 0.5}, {-0.5, share}, {0.5, share}}) {
        const auto line = line_of_screen_point(display.optics, module.emitter,
                                               {at.x * display.screen.width_m, at.y * display.screen.height_m});
        if (!line) continue;
        for (const double depth : {limits.back, limits.front}) {
          const glm::dvec3 end = to_glm(line->on_screen + (depth / display.optics.observer_distance_m) *
                                                              (line->on_observer_line - line->on_screen));
          low = glm::min(low, end);
          high = glm::max(high, end);
        }
      }
    }
  }
  const glm::dvec3 margin = glm::max(high - low, glm::dvec3(0.0)) + display.screen.width_m + display.screen.height_m;
  limits.low = point_of<Physical>(low - margin);
  limits.high = point_of<Physical>(high + margin);
  if (!limits.in_z) return;
  limits.low.z = limits.back;
  limits.high.z = limits.front;
}

}  // namespace

DepthLimits depth_limits(const DisplayCalibration& display, const RenderSettings& settings) {
  const double vz = display.optics.observer_distance_m;
  double singular = -std::numeric_limits<double>::infinity();
  for_places(display, [&](const ModuleCalibration&, ScreenPoint, const PixelLine& line) {
    singular = std::max(singular, line.singular_depth);
  });
  if (!std::isfinite(singular)) singular = -vz;  // no module lights any of these places: nothing will be drawn
  DepthLimits limits;
  limits.in_z = display.optics.screen_radius_m == 0;
  // Kept apart even where the deployment asks for limits outside of what can be shown.
  const double apart = 1e-6 * (vz - singular);
  const double most_m = std::min(0.999 * vz, kMostFront * (display.screen.width_m + display.screen.height_m));
  limits.front = std::clamp(settings.near_z_m.value_or(0.9 * vz), 0.999 * singular + apart, most_m);
  limits.back = std::max(settings.far_z_m.value_or(0.95 * singular), 0.999 * singular);
  limits.back = std::min(limits.back, limits.front - apart);
  bound_space(display, limits);
  double least_w = std::numeric_limits<double>::infinity();
  for_places(display, [&](const ModuleCalibration& module, ScreenPoint s, const PixelLine&) {
    least_w = std::min(least_w, w_at_depth(display.optics, module.emitter, s, limits.back));
  });
  limits.singular = std::min(singular, limits.back - 1e-3 * (limits.front - limits.back));
  constexpr double kBeforeFar = 0.9999;  // the depth buffer's far end, 1, is left to pixels without a surface
  limits.depth_scale = kBeforeFar * std::max(least_w, 1e-9) / (limits.front - limits.back);
  return limits;
}

DepthLimits widened_to(DepthLimits limits, const DisplayCalibration& larger) {
  bound_space(larger, limits);
  return limits;
}

}  // namespace lfd
