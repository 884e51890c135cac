// Pinholes of ideal maps and of homographies, in closed form.
#include "calibration/fit/start.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <variant>

#include "calibration/make.h"

namespace lfd {
namespace {

// image_from_screen (s, y, 1) = K R (P - E) for P = (s, y, 0), so K R = image_from_screen M^-1 with M (s, y, 1) = P -
// E. K, upper triangular, and R, orthogonal, follow by orthogonalising rows from the last one up.
Result<PinholeMap> pinhole_of_homography(const HomographyMap& map, const Emitter& e) {
  const glm::dmat3 from_emitter({1, 0, 0}, {0, 1, 0}, {-e.x, -e.y, -e.z});
  const glm::dmat3 product = glm::transpose(map.image_from_screen * glm::inverse(from_emitter));  // rows as columns
  const double scale = glm::length(product[2]);
  const glm::dvec3 forward = product[2] / scale;
  const double principal_v = glm::dot(product[1], forward);
  const glm::dvec3 down_part = product[1] - principal_v * forward;
  const glm::dvec3 down = glm::normalize(down_part);
  const double principal_u = glm::dot(product[0], forward), skew = glm::dot(product[0], down);
  const glm::dvec3 right_part = product[0] - principal_u * forward - skew * down;
  const glm::dvec3 right = glm::normalize(right_part);
  // Of the unturned module right x down is backward: v grows downward.
  if (!(glm::dot(glm::cross(right, down), forward) < 0) || !(forward.z > 0)) {
    return Error("homography: no pinhole at the emitter has this picture: it is mirrored, or lies behind");
  }
  PinholeMap pinhole;
  pinhole.position = e;
  pinhole.orientation = glm::normalize(glm::quat_cast(glm::dmat3(right, -down, forward)));
  pinhole.focal_u_px = glm::length(right_part) / scale;
  pinhole.focal_v_px = glm::length(down_part) / scale;
  pinhole.principal_u_px = principal_u / scale;
  pinhole.principal_v_px = principal_v / scale;
  return pinhole;
}

}  // namespace

Result<PinholeMap> start_pinhole(const DisplayCalibration& start, const ModuleCalibration& module) {
  if (const auto* pinhole = std::get_if<PinholeMap>(&module.map)) return *pinhole;
  if (const auto* homography = std::get_if<HomographyMap>(&module.map)) {
    LFD_TRY(const PinholeMap pinhole, pinhole_of_homography(*homography, module.emitter));
    if (auto status = validate(pinhole); !status) return status.error().within("homography: as a pinhole");
    return pinhole;
  }
  return pinhole_of_ideal(start.screen, start.image, module.emitter);
}

}  // namespace lfd
