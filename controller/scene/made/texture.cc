// Textures as PNG files.
#include "controller/scene/made/texture.h"

#include <png.h>

#include <cmath>
#include <glm/common.hpp>
#include <vector>

#include "base/check.h"

namespace lfd::scene {

std::string painted_png(int width_px, int height_px, const Painter& paint) {
  std::vector<unsigned char> texels;
  texels.reserve(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) * 3);
  for (int row = 0; row < height_px; ++row) {
    for (int column = 0; column < width_px; ++column) {
      const glm::dvec3 color = glm::clamp(paint((column + 0.5) / width_px, (row + 0.5) / height_px), 0.0, 1.0);
      for (int channel = 0; channel < 3; ++channel) {
        texels.push_back(static_cast<unsigned char>(std::lround(255 * color[channel])));
      }
    }
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width_px);
  image.height = static_cast<png_uint_32>(height_px);
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = 0;
  const bool measured = png_image_write_to_memory(&image, nullptr, &size, 0, texels.data(), 0, nullptr) != 0;
  LFD_CHECK(measured, image.message);
  std::string file(size, '\0');
  const bool written = png_image_write_to_memory(&image, file.data(), &size, 0, texels.data(), 0, nullptr) != 0;
  LFD_CHECK(written, image.message);
  file.resize(size);
  return file;
}

}  // namespace lfd::scene
