// The ideal map as a homography.
#pragma once

#include <glm/mat3x3.hpp>

#include "calibration/maps/ideal.h"

namespace lfd {

// image_from_screen of HomographyMap.
inline glm::dmat3 ideal_homography(ScreenSize screen, ImageSize image) {
  glm::dmat3 h{0.0};
  h[0][0] = image.width / screen.width_m;
  h[1][1] = -image.height / screen.height_m;
  h[2] = {0.5 * image.width, 0.5 * image.height, 1};
  return h;
}

}  // namespace lfd
