// An ordinary perspective picture of a scene, with the screen as the window: what a display aims at.
#pragma once

#include <glm/vec3.hpp>

#include "bench/reference/intersector.h"
#include "calibration/display.h"
#include "proto/pictures/picture.h"

namespace lfd::reference {

struct PerspectiveSettings {
  ImageSize size;            // of the picture; the screen rectangle fills it, row 0 on top
  int samples_per_side = 1;  // n: each pixel is the mean of n x n centred sub-pixels, in linear light
  glm::dvec3 background{0};  // linear
  ZLimits limits{};
};

struct PerspectivePicture {
  PictureF linear;   // alpha 1
  Picture8 encoded;  // the same, clamped to [0, 1], sRGB-encoded, rounded; alpha 255
};

// The unlit base colour of the first surface from the eye (physical, before the screen) through each point of the
// screen, whether that surface lies before or behind the screen. Facing is decided by the eye's own ray.
PerspectivePicture perspective(const Intersector& intersector, ScreenSize screen, Point3<Physical> eye,
                               const PerspectiveSettings& settings);

}  // namespace lfd::reference
