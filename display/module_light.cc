// Tables of the light of every byte.
#include "display/module_light.h"

#include <glm/matrix.hpp>

namespace lfd::display {

ModuleLight::ModuleLight(const ModuleCalibration& module, ImageSize image)
    : color_(module.color ? &*module.color : nullptr), image_(image) {
  for (std::size_t c = 0; c < 3; ++c) {
    const TransferCurve curve = color_ == nullptr ? TransferCurve(SrgbCurve{}) : color_->curve[c];
    for (int byte = 0; byte < 256; ++byte)
      light_of_[c][static_cast<std::size_t>(byte)] = light_from_drive(curve, byte / 255.0);
  }
  if (color_ != nullptr) display_from_device_ = glm::inverse(color_->device_from_display);
}

}  // namespace lfd::display
