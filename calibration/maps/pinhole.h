// A projector as a pinhole with Brown-Conrady distortion, from the screen (metres) to its image (pixels).
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <optional>

#include "base/result.h"
#include "calibration/spaces/pixel.h"
#include "calibration/spaces/spaces.h"

namespace lfd {

// The module's frame has x to the right and y down *as a viewer before the screen sees its picture*, z forward, from
// the projector toward the screen. Unturned (identity) it looks straight at the screen: x_module = X, y_module = -Y,
// z_module = Z of physical space. (That is a left-handed frame: a projector behind the screen shows its picture
// mirrored, and this takes the mirror out.)
//   q = diag(1, -1, 1) orientation^-1 (P - position);  a = q.xy / q.z;  r2 = |a|^2
//   a' = a (1 + k1 r2 + k2 r2^2 + k3 r2^3) + (2 p1 ax ay + p2 (r2 + 2 ax^2), p1 (r2 + 2 ay^2) + 2 p2 ax ay)
//   (u, v) = focal * a' + principal          (Brown 1966, in OpenCV's order of names)
struct PinholeMap {
  Point3<Physical> position;                   // of the pinhole, metres; usually the emitter
  glm::dquat orientation{1.0, 0.0, 0.0, 0.0};  // turns the unturned module, unit quaternion (w, x, y, z)
  double focal_u_px = 1, focal_v_px = 1;       // > 0
  double principal_u_px = 0, principal_v_px = 0;
  double k1 = 0, k2 = 0, k3 = 0, p1 = 0, p2 = 0;
  bool operator==(const PinholeMap&) const = default;
};

// Refuses numbers that are not finite or beyond calibration/limits.h, focal lengths <= 0, orientations that are not of
// unit length (kUnitLengthError).
Status validate(const PinholeMap& map);

// The radius up to which the radial polynomial grows, i.e. up to which it can be inverted; infinity where it always
// grows.
double distortion_limit(const PinholeMap& map);

// The largest distance, in normalised coordinates, of a corner of the image from the optical axis.
double corner_radius(const PinholeMap& map, ImageSize image);

// Rotation from physical to module axes, the mirroring of the frame included.
glm::dmat3 module_from_physical_rotation(const PinholeMap& map);

// The distortion alone: a' of a, in normalised coordinates.
glm::dvec2 distort(const PinholeMap& map, glm::dvec2 a);

// Pixel of a physical point. Absent behind the projector and where the distortion has turned back (beyond its limit, or
// its Jacobian mirrors).
std::optional<PixelPoint> image_from_point(const PinholeMap& map, Point3<Physical> p);

// Direction, in physical space and not of unit length, in which the pinhole sees a pixel, by safeguarded Newton, to
// rounding where it can, to 1e-12 relative at worst; absent where nothing within the distortion's limit lands on `p`.
std::optional<Vector3<Physical>> direction_of_pixel(const PinholeMap& map, PixelPoint p);

// The same on a planar screen.
std::optional<PixelPoint> image_from_screen(const PinholeMap& map, ScreenPoint s);

std::optional<ScreenPoint> screen_from_image(const PinholeMap& map, PixelPoint p);

}  // namespace lfd
