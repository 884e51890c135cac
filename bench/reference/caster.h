// What each pixel of a module must show: its own line, cast into the scene.
#pragma once

#include <optional>
#include <vector>

#include "bench/reference/intersector.h"
#include "calibration/display.h"

namespace lfd::reference {

// One module of a display, and where geometry is cut. Refers to both; they must outlive it.
struct ModuleView {
  const DisplayCalibration& display;
  const ModuleCalibration& module;
  ZLimits limits{};
};

// What every pixel of a module shows; rows from the top.
struct HitImage {
  ImageSize size;
  std::vector<std::optional<Hit>> hit;

  const std::optional<Hit>& at(PixelIndex i) const {
    return hit[static_cast<std::size_t>(i.row) * size.width + i.column];
  }
};

// The part of a line that can show a surface, from the observer's side to the far one: depths from min(vz, near) to
// max(singular, far). Absent where that is empty. Source: design geometry, section 2.
struct VisibleWay {
  Point3<Physical> nearest, farthest;
  double nearest_depth = 0, farthest_depth = 0;  // metres
};
std::optional<VisibleWay> visible_way(const ModuleView& view, const PixelLine& line);

// The surface of largest depth on the line of an image point (any point, not centres alone).
std::optional<Hit> cast_point(const Intersector& intersector, const ModuleView& view, PixelPoint p);

// The same for the centres of all pixels, on all cores; the result does not depend on their number.
HitImage cast_module(const Intersector& intersector, const ModuleView& view);

}  // namespace lfd::reference
