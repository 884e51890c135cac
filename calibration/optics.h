// What the special screen does: light passes straight horizontally and is spread vertically (planar screens).
//
// Equations: design geometry, section 2. With emitter E = (ex, ey, ez), ez < 0, the screen at z = 0 and the observer
// line at height vy, distance vz > 0, a physical point P = (x, y, z) is shown by lighting the screen point S = (sx, sy,
// 0):
//   sy = vy + (y - vy) vz / (vz - z)
//   sx = (x + ex k z / vz) / (1 + k z / vz),
//   k  = vz / -ez                                                  linear diffuser
//   k  = sqrt((vy - sy)^2 + vz^2) / sqrt((sy - ey)^2 + ez^2)       conical diffuser
#pragma once

#include <optional>

#include "base/result.h"
#include "calibration/spaces/spaces.h"

namespace lfd {

enum class Diffuser { kLinear, kConical };

// The part of the optics that all modules of a display share.
struct Optics {
  Diffuser diffuser = Diffuser::kLinear;
  double observer_height_m = 0;    // vy
  double observer_distance_m = 1;  // vz, > 0
  bool operator==(const Optics&) const = default;
};

using Emitter = Point3<Physical>;  // z < 0

// All physical points that one pixel shows: R(t) = on_screen + t (on_observer_line - on_screen); z grows with t, t = 1
// at the observer line. Of two points on it the one with the larger z hides the other.
struct PixelLine {
  Point3<Physical> on_screen;
  Point3<Physical> on_observer_line;
};

// Refuses an observer not in front of the screen and numbers that are not finite; an error names the field.
Status validate(const Optics& optics);

// Refuses an emitter not behind the screen and numbers that are not finite; an error begins with "emitter: ".
Status validate(const Emitter& emitter);

// k of the equations above for a screen point at height `sy`, always > 0.
double convergence(const Optics& optics, const Emitter& emitter, double sy);

// Where P is shown. Absent (no image) unless ez < z < vz and 1 + k z / vz > 0, and where the result is not finite.
std::optional<ScreenPoint> screen_from_physical(const Optics& optics, const Emitter& emitter, Point3<Physical> p);

// The line of physical points that lighting the screen point shows. Absent where a coordinate is not finite.
std::optional<PixelLine> line_of_screen_point(const Optics& optics, const Emitter& emitter, ScreenPoint s);

// The z at or behind which points on the line of a screen point at height `sy` have no image: max(ez, -vz / k).
double nearest_singular_z(const Optics& optics, const Emitter& emitter, double sy);

}  // namespace lfd
