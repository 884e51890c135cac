// Whether a box of physical space can have an image in a module, by bounds on its screen points.
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "rendernode/plan/frame_plan.h"

namespace lfd {
namespace {

struct Range {
  double low, high;
};

Range range_of(std::initializer_list<double> values) { return {std::min(values), std::max(values)}; }

// Range of |sy - centre| over the rows.
Range distance_range(Range sy, double centre) {
  const double a = std::abs(sy.low - centre), b = std::abs(sy.high - centre);
  const bool inside = sy.low <= centre && centre <= sy.high;
  return {inside ? 0 : std::min(a, b), std::max(a, b)};
}

// Range of k over the rows (calibration/optics.h).
Range convergence_range(const Optics& optics, const Emitter& emitter, Range sy) {
  const double vz = optics.observer_distance_m;
  if (optics.diffuser == Diffuser::kLinear) return {vz / -emitter.z, vz / -emitter.z};
  const Range observer = distance_range(sy, optics.observer_height_m), below = distance_range(sy, emitter.y);
  return {std::hypot(observer.low, vz) / std::hypot(below.high, emitter.z),
          std::hypot(observer.high, vz) / std::hypot(below.low, emitter.z)};
}

// Whether a vertical prism over a rectangle of (x, z) may lie in the directions in which the emitter lights a curved
// screen (height is not looked at). The lit arc is enclosed in the corners of tangents: whatever lies in its directions
// lies in theirs.
bool may_be_seen_on_cylinder(const DisplayCalibration& display, const Emitter& emitter, Point3<Physical> low,
                             Point3<Physical> high, double slack_m) {
  if (!(low.z > emitter.z)) return true;
  const auto direction = [&](double x, double z) { return std::atan2(x - emitter.x, z - emitter.z); };
  const Range box = range_of(
      {direction(low.x, low.z), direction(low.x, high.z), direction(high.x, low.z), direction(high.x, high.z)});
  constexpr int kParts = 8;  // of at most a half circle: tangents at their ends meet
  const double radius = display.optics.screen_radius_m, half_width = 0.5 * display.screen.width_m + slack_m;
  const double step = 2 * half_width / kParts;
  Range arc{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (int i = 0; i <= 2 * kParts; ++i) {
    // Even places on the arc, odd ones where the tangents on both sides meet: farther from the axis.
    const double angle = (-half_width + 0.5 * i * step) / radius;
    const double from_axis = i % 2 == 0 ? radius : radius / std::cos(0.5 * step / radius);
    const double x = from_axis * std::sin(angle), z = from_axis * std::cos(angle) - radius;
    if (!(z > emitter.z)) return true;
    arc = {std::min(arc.low, direction(x, z)), std::max(arc.high, direction(x, z))};
  }
  return box.low <= arc.high && box.high >= arc.low;
}

}  // namespace

bool may_be_seen(const DisplayCalibration& display, const ModuleCalibration& module, Point3<Physical> low,
                 Point3<Physical> high) {
  // Half a pixel of slack covers rounding on the GPU.
  const double slack_x = 0.5 * display.screen.width_m / display.image.width;
  const double slack_y = 0.5 * display.screen.height_m / display.image.height;
  if (display.optics.screen_radius_m != 0) return may_be_seen_on_cylinder(display, module.emitter, low, high, slack_x);
  const double vz = display.optics.observer_distance_m, vy = display.optics.observer_height_m;
  if (!(high.z < vz)) return true;
  // sy is linear in y at a given z, and monotone in z at a given y: its extremes are at the corners.
  const double near_scale = vz / (vz - high.z), far_scale = vz / (vz - low.z);
  const Range sy = range_of({vy + (low.y - vy) * near_scale, vy + (low.y - vy) * far_scale,
                             vy + (high.y - vy) * near_scale, vy + (high.y - vy) * far_scale});
  const double half_width = 0.5 * display.screen.width_m + slack_x,
               half_height = 0.5 * display.screen.height_m + slack_y;
  if (sy.low > half_height || sy.high < -half_height) return false;
  const Range k = convergence_range(display.optics, module.emitter, sy);
  const Range w =
      range_of({1 + k.low * low.z / vz, 1 + k.low * high.z / vz, 1 + k.high * low.z / vz, 1 + k.high * high.z / vz});
  if (!(w.low > 0)) return true;
  const double ex = module.emitter.x;
  const Range sx = range_of(
      {ex + (low.x - ex) / w.low, ex + (low.x - ex) / w.high, ex + (high.x - ex) / w.low, ex + (high.x - ex) / w.high});
  return sx.low <= half_width && sx.high >= -half_width;
}

}  // namespace lfd
