// Rays against arcs, in a form that is exact for large radii.
#include "calibration/curved_screen.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace lfd {

std::optional<double> CurvedScreen::rise_through(glm::dvec2 from, glm::dvec2 direction, double level_m) const {
  // f(from + t direction) - level = a t^2 + b t + c; of its roots the one where it grows, -b + sqrt(D) above.
  const double a = 0.5 * curvature_;
  const double b = glm::dot(outward(from), direction);
  const double c = level(from) - level_m;
  const double discriminant = b * b - 4 * a * c;
  if (!(discriminant > 0)) return std::nullopt;
  const double root = std::sqrt(discriminant);
  // The form without cancellation: for a plane (a = 0) it is -c / b.
  const double t = b > 0 ? -2 * c / (b + root) : (root - b) / (2 * a);
  if (!std::isfinite(t)) return std::nullopt;
  return t;
}

glm::dvec2 CurvedScreen::point_at(double s) const {
  const double half_angle = 0.5 * curvature_ * s;
  // R sin(s / R) and R (cos(s / R) - 1), by half angles: no digits are lost for large radii.
  const double sinc = half_angle == 0 ? 1 : std::sin(half_angle) / half_angle;
  return {s * sinc * std::cos(half_angle), -s * sinc * std::sin(half_angle)};
}

std::optional<double> CurvedScreen::arc_length_of(glm::dvec2 q) const {
  const glm::dvec2 normal = outward(q);
  if (!(normal.y > 0)) return std::nullopt;
  return std::atan2(normal.x, normal.y) / curvature_;
}

}  // namespace lfd
