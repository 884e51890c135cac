// Homographies forward and backward.
#include "calibration/maps/homography.h"

#include <cmath>
#include <glm/matrix.hpp>

#include "base/log.h"

namespace lfd {

Status validate(const HomographyMap& map) {
  const glm::dmat3& h = map.image_from_screen;
  double product = 1;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      if (!std::isfinite(h[column][row])) return Error("h: all 9 numbers must be finite");
    }
    product *= glm::length(h[column]);
  }
  const double determinant = glm::determinant(h);
  if (!(std::abs(determinant) > 1e-12 * product)) {
    return Error(fmt::format("h: cannot be inverted (determinant {})", determinant));
  }
  return {};
}

std::optional<PixelPoint> image_from_screen(const HomographyMap& map, ScreenPoint s) {
  const glm::dvec3 q = map.image_from_screen * glm::dvec3(s.x, s.y, 1);
  if (!(q.z > 0)) return std::nullopt;
  const PixelPoint p{q.x / q.z, q.y / q.z};
  if (!is_finite(p)) return std::nullopt;
  return p;
}

std::optional<ScreenPoint> screen_from_image(const HomographyMap& map, PixelPoint p) {
  const glm::dvec3 q = glm::inverse(map.image_from_screen) * glm::dvec3(p.x, p.y, 1);
  const ScreenPoint s{q.x / q.z, q.y / q.z};
  // The point must lie on the positive side, where the forward map is defined.
  if (!is_finite(s) || !image_from_screen(map, s)) return std::nullopt;
  return s;
}

}  // namespace lfd
