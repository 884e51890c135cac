// The equations of the screen in 113-bit arithmetic, in their homogeneous form: an independent reference for double.
#pragma once

#include <cmath>

#include "calibration/optics.h"

namespace lfd::bench {

__extension__ typedef __float128 Quad;

// Newton's method from a long double: two steps reach 113 bits.
inline Quad quad_sqrt(Quad x) {
  if (!(x > 0)) return 0;
  Quad root = std::sqrt(static_cast<long double>(x));
  for (int i = 0; i < 2; ++i) root = (root + x / root) / 2;
  return root;
}

struct QuadScreenPoint {
  double x = 0, y = 0;  // rounded once
  double w = 0;         // 1 + k z / vz
};

// sx = (x vz + ex k z) / (vz + k z), sy = (vy (vz - z) + (y - vy) vz) / (vz - z), with linear k multiplied through by
// -ez (design geometry, section 2). Planar screens.
inline QuadScreenPoint quad_screen_from_physical(const Optics& optics, const Emitter& e, Point3<Physical> p) {
  const Quad vz = optics.observer_distance_m, vy = optics.observer_height_m;
  const Quad x = p.x, y = p.y, z = p.z, ex = e.x, ey = e.y, ez = e.z;
  const Quad sy = (vy * (vz - z) + (y - vy) * vz) / (vz - z);
  const bool is_linear = optics.diffuser == Diffuser::kLinear;
  const Quad above = is_linear ? vz : quad_sqrt((vy - sy) * (vy - sy) + vz * vz);
  const Quad below = is_linear ? -ez : quad_sqrt((sy - ey) * (sy - ey) + ez * ez);
  const Quad sx = (x * vz * below + ex * above * z) / (vz * below + above * z);
  return {static_cast<double>(sx), static_cast<double>(sy), static_cast<double>(1 + above * z / (below * vz))};
}

}  // namespace lfd::bench
