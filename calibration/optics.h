// What the special screen does: light passes straight horizontally and is spread vertically.
//
// Equations: design geometry, section 2. With emitter E = (ex, ey, ez), ez < 0, the screen at z = 0 and the observer
// line at height vy, distance vz > 0, a physical point P = (x, y, z) is shown by lighting the screen point S = (sx, sy,
// 0):
//   sy = vy + (y - vy) vz / (vz - z)
//   sx = (x + ex k z / vz) / (1 + k z / vz),
//   k  = vz / -ez                                                  linear diffuser
//   k  = sqrt((vy - sy)^2 + vz^2) / sqrt((sy - ey)^2 + ez^2)       conical diffuser
// A curved screen is a vertical cylinder, with a linear diffuser. The horizontal ray from E through P crosses it toward
// the viewer at S and meets the observer line, or arc, at O; with path lengths along that ray, 0 at S,
//   sy = vy + (y - vy) tO / (tO - tP),   valid where tE < tP < tO;   the planar case is this with t proportional to z.
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
  // Radius of a cylindrical screen through the origin, its axis at z = -radius: positive with the axis behind the
  // screen (convex to the viewer), negative with it in front (concave). 0: planar.
  double screen_radius_m = 0;
  // Where the screen is curved: observers stand on the arc concentric with it through (0, vz), of radius
  // |screen_radius_m + vz|, not on the line z = vz.
  bool observer_arc = false;
  bool operator==(const Optics&) const = default;
};

using Emitter = Point3<Physical>;  // z < 0

// All physical points that one pixel shows: R(t) = on_screen + t (on_observer_line - on_screen), t = 1 at the observer
// line. Of two points on it the one with the larger t hides the other. vz t is called *depth*, in metres; on a planar
// screen it is z.
struct PixelLine {
  Point3<Physical> on_screen;
  Point3<Physical> on_observer_line;
  double singular_depth = 0;  // metres, < 0: points at or behind it have no image
};

// Refuses an observer not in front of the screen, a conical diffuser on a curved screen, an observer arc beyond the
// axis of a concave one, and numbers that are not finite or beyond calibration/limits.h; an error names the field.
Status validate(const Optics& optics);

// Refuses an emitter not behind the screen and numbers that are not finite or beyond calibration/limits.h; an error
// begins with "emitter: ".
Status validate(const Emitter& emitter);

// k of the equations above for a screen point at height `sy`, always > 0.
double convergence(const Optics& optics, const Emitter& emitter, double sy);

// Where P is shown. Absent (no image) unless ez < z < vz and 1 + k z / vz > 0 (planar) or tE < tP < tO (curved), where
// the ray misses the arc or does not cross it toward the viewer, and where the result is not finite.
std::optional<ScreenPoint> screen_from_physical(const Optics& optics, const Emitter& emitter, Point3<Physical> p);

// The line of physical points that lighting the screen point shows. Absent where a coordinate is not finite and where
// light from the emitter does not cross a curved screen toward the viewer there.
std::optional<PixelLine> line_of_screen_point(const Optics& optics, const Emitter& emitter, ScreenPoint s);

// Everything about a physical point but where it is in an image. w is the factor by which a module's picture of the
// plane through the point shrinks toward the screen: 1 there, 0 where the lines of all pixels meet.
struct OnScreen {
  ScreenPoint at;
  double depth = 0;  // metres
  double w = 1;      // 1 + k z / vz; curved: (tP - tE) / -tE. Positive
};

// w of the point of a depth on the line of a screen point; not positive where it has no image.
double w_at_depth(const Optics& optics, const Emitter& emitter, ScreenPoint s, double depth);

// Where P is shown, also beside the screen's border; absent as for screen_from_physical.
std::optional<OnScreen> on_screen(const Optics& optics, const Emitter& emitter, Point3<Physical> p);

// A point of the screen's surface in space; on a planar screen (s, y, 0).
Point3<Physical> surface_point(const Optics& optics, ScreenPoint s);

}  // namespace lfd
