// The drawn map in double precision.
#include "rendernode/geometry/clip_map.h"

#include <glm/geometric.hpp>

namespace lfd {

glm::dmat3 ideal_homography(ScreenSize screen, ImageSize image) {
  glm::dmat3 h{0.0};
  h[0][0] = image.width / screen.width_m;
  h[1][1] = -image.height / screen.height_m;
  h[2] = {0.5 * image.width, 0.5 * image.height, 1};
  return h;
}

ClipMap::ClipMap(const DisplayCalibration& display, const ModuleCalibration& module)
    : display_(&display), module_(&module) {
  if (const auto* homography = std::get_if<HomographyMap>(&module.map)) {
    homography_ = homography->image_from_screen;
  } else if (const auto* pinhole = std::get_if<PinholeMap>(&module.map)) {
    rotation_ = module_from_physical_rotation(*pinhole);
    limit_ = distortion_limit(*pinhole);
  } else {
    homography_ = ideal_homography(display.screen, display.image);
  }
}

glm::dvec3 ClipMap::screen_from_physical(Point3<Physical> p) const {
  const double vz = display_->optics.observer_distance_m, vy = display_->optics.observer_height_m;
  const Emitter& e = module_->emitter;
  const double sy = vy + (p.y - vy) * (vz / (vz - p.z));
  const double w = display_->optics.diffuser == Diffuser::kLinear
                       ? (p.z - e.z) / -e.z
                       : 1 + convergence(display_->optics, e, sy) * (p.z / vz);
  return {e.x + (p.x - e.x) / w, sy, w};
}

std::optional<glm::dvec2> ClipMap::image_from_screen(glm::dvec2 s) const {
  const auto* pinhole = std::get_if<PinholeMap>(&module_->map);
  if (pinhole == nullptr) {
    const glm::dvec3 q = homography_ * glm::dvec3(s, 1);
    if (!(q.z > 0)) return std::nullopt;
    return glm::dvec2(q) / q.z;
  }
  const glm::dvec3 q = rotation_ * (glm::dvec3(s, 0) - to_glm(pinhole->position));
  if (!(q.z > 0)) return std::nullopt;
  const glm::dvec2 a = glm::dvec2(q) / q.z;
  const double radius = glm::length(a);
  const glm::dvec2 inner = radius < limit_ ? a : a * (limit_ / radius);
  const glm::dvec2 distorted = distort(*pinhole, inner) + (a - inner);
  return glm::dvec2(pinhole->focal_u_px * distorted.x + pinhole->principal_u_px,
                    pinhole->focal_v_px * distorted.y + pinhole->principal_v_px);
}

std::optional<ClipPoint> ClipMap::clip_from_physical(Point3<Physical> p) const {
  const glm::dvec3 s = screen_from_physical(p);
  if (!(s.z > 0)) return std::nullopt;
  const auto pixel = image_from_screen(glm::dvec2(s));
  if (!pixel) return std::nullopt;
  return ClipPoint(*pixel * s.z, s.z);
}

}  // namespace lfd
