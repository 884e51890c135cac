// The drawn map in double precision.
#include "rendernode/geometry/clip_map.h"

#include <glm/geometric.hpp>

#include "base/check.h"

namespace lfd {

ClipMap::ClipMap(const DisplayCalibration& display, const ModuleCalibration& module, const WarpTable* table)
    : display_(&display), module_(&module), table_(table) {
  LFD_CHECK((table != nullptr) == std::holds_alternative<GridMap>(module.map), "a grid, and nothing else, has a table");
  if (const auto* homography = std::get_if<HomographyMap>(&module.map)) {
    homography_ = homography->image_from_screen;
  } else if (const auto* pinhole = std::get_if<PinholeMap>(&module.map)) {
    rotation_ = module_from_physical_rotation(*pinhole);
    limit_ = distortion_limit(*pinhole);
  } else {
    homography_ = ideal_homography(display.screen, display.image);
  }
}

std::optional<OnScreen> ClipMap::screen_from_physical(Point3<Physical> p) const {
  if (is_curved()) return on_screen(display_->optics, module_->emitter, p);
  const double vz = display_->optics.observer_distance_m, vy = display_->optics.observer_height_m;
  const Emitter& e = module_->emitter;
  const double sy = vy + (p.y - vy) * (vz / (vz - p.z));
  const double w = display_->optics.diffuser == Diffuser::kLinear
                       ? (p.z - e.z) / -e.z
                       : 1 + convergence(display_->optics, e, sy) * (p.z / vz);
  return OnScreen{{e.x + (p.x - e.x) / w, sy}, p.z, w};
}

std::optional<glm::dvec2> ClipMap::image_from_screen(ScreenPoint s) const {
  if (table_ != nullptr) return table_->at({s.x, s.y});
  const auto* pinhole = std::get_if<PinholeMap>(&module_->map);
  if (pinhole == nullptr) {
    const glm::dvec3 q = homography_ * glm::dvec3(s.x, s.y, 1);
    if (!(q.z > 0)) return std::nullopt;
    return glm::dvec2(q) / q.z;
  }
  const glm::dvec3 q = rotation_ * to_glm(surface_point(display_->optics, s) - pinhole->position);
  if (!(q.z > 0)) return std::nullopt;
  const glm::dvec2 a = glm::dvec2(q) / q.z;
  const double radius = glm::length(a);
  const glm::dvec2 inner = radius < limit_ ? a : a * (limit_ / radius);
  const glm::dvec2 distorted = distort(*pinhole, inner) + (a - inner);
  return glm::dvec2(pinhole->focal_u_px * distorted.x + pinhole->principal_u_px,
                    pinhole->focal_v_px * distorted.y + pinhole->principal_v_px);
}

std::optional<ClipPoint> ClipMap::clip_from_physical(Point3<Physical> p) const {
  const auto s = screen_from_physical(p);
  if (!s || !(s->w > 0)) return std::nullopt;
  const auto pixel = image_from_screen(s->at);
  if (!pixel) return std::nullopt;
  return ClipPoint(*pixel * s->w, s->w);
}

}  // namespace lfd
