// Horizontal geometry of a screen that is a vertical cylinder (design geometry, section 2): rays, arcs, path lengths.
//
// With the radius R (positive: the axis is behind the screen, convex to the viewer; negative: before it, concave) and
// the axis at x = 0, z = -R, the function f(x, z) = z + (x^2 + z^2) / (2 R) is 0 on the screen, negative behind and
// positive before it near the screen, and constant on every concentric arc. A ray crosses the screen toward the viewer
// where f grows through 0. All formulas go over into those of a plane as R grows: f becomes z.
#pragma once

#include <glm/vec2.hpp>
#include <optional>

namespace lfd {

// Points and directions are (x, z) in physical metres.
class CurvedScreen {
 public:
  // radius_m: not 0, finite.
  explicit CurvedScreen(double radius_m) : curvature_(1 / radius_m) {}

  // f, in metres.
  double level(glm::dvec2 q) const { return q.y + 0.5 * curvature_ * (q.x * q.x + q.y * q.y); }

  // How far from `from` along the unit vector `direction` f grows through `level_m`; negative where that lies behind.
  // Absent where the ray misses the arc or meets it only sinking.
  std::optional<double> rise_through(glm::dvec2 from, glm::dvec2 direction, double level_m) const;

  // The point at arc length s from the middle.
  glm::dvec2 point_at(double s) const;

  // Arc length of a point on the screen; absent on the half of the cylinder that is turned away.
  std::optional<double> arc_length_of(glm::dvec2 q) const;

  // Direction in which f grows: outward, toward the viewer; of length 1 on the screen.
  glm::dvec2 outward(glm::dvec2 q) const { return {curvature_ * q.x, 1 + curvature_ * q.y}; }

 private:
  double curvature_;  // 1 / m
};

}  // namespace lfd
