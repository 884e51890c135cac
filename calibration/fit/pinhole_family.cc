// The scales of a pinhole's parameters.
#include "calibration/fit/pinhole_family.h"

#include <cmath>
#include <numbers>

namespace lfd {

PinholeFamily::PinholeFamily(const PinholeMap& start, ImageSize image, double position_sd_m) : start_(start) {
  const glm::dmat3 rotation = glm::mat3_cast(glm::normalize(start.orientation));  // physical from turned
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      start_rotation_[static_cast<std::size_t>(3 * row + column)] = rotation[row][column];  // transposed
    }
  }
  const double turn = std::numbers::pi / 180;
  const double r = corner_radius(start, image), share = image.width / start.focal_u_px;
  sd_ = {position_sd_m,
         position_sd_m,
         position_sd_m,
         turn,
         turn,
         turn,
         0.02,
         0.02,
         0.03 * image.width,
         0.03 * image.width,
         0.03 * share / std::pow(r, 3),
         0.02 * share / std::pow(r, 5),
         0.01 * share / std::pow(r, 7),
         0.03 * share / (3 * r * r),
         0.03 * share / (3 * r * r)};
}

PinholeMap PinholeFamily::at(const PinholeVector& z) const {
  const auto of = [&](std::size_t i) { return z[i] * sd_[i]; };
  PinholeMap map = start_;
  map.position = start_.position + Vector3<Physical>{of(0), of(1), of(2)};
  const glm::dvec3 turn(of(3), of(4), of(5));
  const double angle = glm::length(turn);
  const glm::dvec3 half = turn * (0.5 * detail::sinc(0.5 * angle));
  map.orientation = glm::normalize(start_.orientation) * glm::dquat(std::cos(0.5 * angle), half.x, half.y, half.z);
  map.orientation = glm::normalize(map.orientation);
  map.focal_u_px *= std::exp(of(6));
  map.focal_v_px *= std::exp(of(7));
  map.principal_u_px += of(8);
  map.principal_v_px += of(9);
  map.k1 += of(10);
  map.k2 += of(11);
  map.k3 += of(12);
  map.p1 += of(13);
  map.p2 += of(14);
  return map;
}

}  // namespace lfd
