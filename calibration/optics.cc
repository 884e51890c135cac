// The equations of the screen, in double precision.
#include "calibration/optics.h"

#include <algorithm>
#include <cmath>

#include "base/log.h"

namespace lfd {

Status validate(const Optics& optics) {
  const double vz = optics.observer_distance_m;
  if (!std::isfinite(optics.observer_height_m)) return Error("observer_height_m: must be finite");
  if (!(vz > 0) || !std::isfinite(vz)) {
    return Error(
        fmt::format("observer_distance_m: {} must be positive and finite: the observer stands before the screen", vz));
  }
  return {};
}

Status validate(const Emitter& emitter) {
  if (!is_finite(emitter)) return Error("emitter: must be finite");
  if (!(emitter.z < 0))
    return Error(fmt::format("emitter: z = {} must be negative: it stands behind the screen", emitter.z));
  return {};
}

double convergence(const Optics& optics, const Emitter& emitter, double sy) {
  const double vz = optics.observer_distance_m;
  if (optics.diffuser == Diffuser::kLinear) return vz / -emitter.z;
  return std::hypot(optics.observer_height_m - sy, vz) / std::hypot(sy - emitter.y, emitter.z);
}

std::optional<ScreenPoint> screen_from_physical(const Optics& optics, const Emitter& emitter, Point3<Physical> p) {
  const double vz = optics.observer_distance_m;
  const double vy = optics.observer_height_m;
  if (!(p.z > emitter.z) || !(p.z < vz)) return std::nullopt;
  const double sy = vy + (p.y - vy) * (vz / (vz - p.z));
  double sx = 0;
  if (optics.diffuser == Diffuser::kLinear) {
    // Not (x + ex k z / vz) / (1 + k z / vz): near the emitter plane that loses every digit.
    sx = emitter.x + (p.x - emitter.x) * (-emitter.z / (p.z - emitter.z));
  } else {
    const double kz = convergence(optics, emitter, sy) * (p.z / vz);
    if (!(1 + kz > 0)) return std::nullopt;
    sx = emitter.x + (p.x - emitter.x) / (1 + kz);
  }
  const ScreenPoint s{sx, sy};
  if (!is_finite(s)) return std::nullopt;
  return s;
}

std::optional<PixelLine> line_of_screen_point(const Optics& optics, const Emitter& emitter, ScreenPoint s) {
  const double vz = optics.observer_distance_m;
  const double ox = s.x + (s.x - emitter.x) * convergence(optics, emitter, s.y);
  const PixelLine line{{s.x, s.y, 0}, {ox, optics.observer_height_m, vz}};
  if (!is_finite(line.on_screen) || !is_finite(line.on_observer_line)) return std::nullopt;
  return line;
}

double nearest_singular_z(const Optics& optics, const Emitter& emitter, double sy) {
  return std::max(emitter.z, -optics.observer_distance_m / convergence(optics, emitter, sy));
}

}  // namespace lfd
