// The light that a module makes of the bytes it is fed, by its colour calibration (calibration/color.h).
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "calibration/display.h"

namespace lfd::display {

// Holds on to the calibration it is made of. Light is linear r g b.
class ModuleLight {
 public:
  ModuleLight(const ModuleCalibration& module, ImageSize image);

  // `texel`: r g b. Without a colour calibration they are sRGB.
  glm::dvec3 emitted(const std::uint8_t* texel) const {
    const glm::dvec3 device(light_of_[0][texel[0]], light_of_[1][texel[1]], light_of_[2][texel[2]]);
    return color_ == nullptr ? device : color_->black_level + display_from_device_ * device;
  }

  // The share of the light that the module is meant to emit at the pixel; 1 without a colour calibration.
  glm::dvec3 gain(PixelIndex i) const {
    return color_ == nullptr ? glm::dvec3(1) : gain_at(color_->gain, image_, centre_of(i));
  }

 private:
  const ColorCalibration* color_;  // null: none
  ImageSize image_;
  std::array<std::array<double, 256>, 3> light_of_;  // of a channel's byte, as a share of the device's full light
  glm::dmat3 display_from_device_{1};
};

}  // namespace lfd::display
