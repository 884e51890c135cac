// Textures as PNG files.
#include "controller/scene/made/texture.h"

#include <cmath>
#include <glm/common.hpp>

#include "base/check.h"
#include "proto/pictures/png.h"

namespace lfd::scene {

std::string painted_png(int width_px, int height_px, const Painter& paint) {
  Picture8 picture{width_px, height_px, {}};
  picture.rgba.reserve(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) * 4);
  for (int row = 0; row < height_px; ++row) {
    for (int column = 0; column < width_px; ++column) {
      const glm::dvec3 color = glm::clamp(paint((column + 0.5) / width_px, (row + 0.5) / height_px), 0.0, 1.0);
      for (int channel = 0; channel < 3; ++channel) {
        picture.rgba.push_back(static_cast<std::uint8_t>(std::lround(255 * color[channel])));
      }
      picture.rgba.push_back(255);
    }
  }
  auto file = encode_png(picture, PngChannels::kRgb);
  LFD_CHECK(file, file.error().message());
  return *std::move(file);
}

}  // namespace lfd::scene
