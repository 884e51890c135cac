// The map's shader functions, called on the GPU for single points.
#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "base/result.h"
#include "calibration/display.h"

namespace lfd::bench {

// image_from_physical of lib/image_map.glsl (pixel, depth, 1; or zeros where there is no image) for module 0 of each
// display at each point: results in the order of displays, then points. Maps other than grids. A context is current.
Result<std::vector<glm::vec4>> gpu_images(const std::vector<DisplayCalibration>& displays,
                                          const std::vector<Point3<Physical>>& points);

}  // namespace lfd::bench
