// Where the vertex shader puts a corner, in double precision: the twin of shaders/passes/surface.vert.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "calibration/display.h"
#include "calibration/maps/ideal_homography.h"
#include "rendernode/geometry/warp_table.h"

namespace lfd {

// A corner before the division: (u w, v w, w) in pixels. What lies between two corners is drawn on the straight line
// between them.
using ClipPoint = glm::dvec3;

// The map of one module, prepared for many points. Unlike image_from_physical it goes on beside the screen and the
// image, and beyond the radius where a distortion turns back: a triangle's corner needs a place there too.
class ClipMap {
 public:
  // `table` is that of a module with a GridMap, else null; all outlive the map.
  ClipMap(const DisplayCalibration& display, const ModuleCalibration& module, const WarpTable* table);

  // Absent where there is no place: w <= 0, or behind a homography's horizon or a pinhole.
  std::optional<ClipPoint> clip_from_physical(Point3<Physical> p) const;

  // The screen point alone, also beside the screen. On a planar screen it always exists, and w says whether it counts.
  std::optional<OnScreen> screen_from_physical(Point3<Physical> p) const;

  bool is_curved() const { return display_->optics.screen_radius_m != 0; }

 private:
  std::optional<glm::dvec2> image_from_screen(ScreenPoint s) const;

  const DisplayCalibration* display_;
  const ModuleCalibration* module_;
  const WarpTable* table_;
  glm::dmat3 homography_{1.0};  // ideal and homography maps
  glm::dmat3 rotation_{1.0};    // pinholes: module_from_physical
  double limit_ = 0;            // pinholes: largest radius that can be inverted
};

}  // namespace lfd
