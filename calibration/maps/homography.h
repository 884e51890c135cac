// A homography from the screen (metres) to the image (pixels).
#pragma once

#include <glm/mat3x3.hpp>
#include <optional>

#include "base/result.h"
#include "calibration/spaces/spaces.h"

namespace lfd {

// image_from_screen * (s, y, 1) ~ (u, v, 1), up to a factor that must be positive wherever the map is used.
// Column-major like all of GLM.
struct HomographyMap {
  glm::dmat3 image_from_screen{1.0};
  bool operator==(const HomographyMap&) const = default;
};

// Refuses matrices that are not finite or that cannot be inverted (|det| relative to the entries below 1e-12).
Status validate(const HomographyMap& map);

// Absent on and behind the horizon line of the homography.
std::optional<PixelPoint> image_from_screen(const HomographyMap& map, ScreenPoint s);
std::optional<ScreenPoint> screen_from_image(const HomographyMap& map, PixelPoint p);

}  // namespace lfd
