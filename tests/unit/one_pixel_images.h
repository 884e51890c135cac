// Images of one pixel that say which frame and module they are, for tests of the display.
#pragma once

#include <memory>
#include <string>

#include "display/frame_assembly.h"

namespace lfd::display {

inline constexpr ImageSize kOnePixel{1, 1};

inline proto::Image image_of(std::uint64_t frame, std::uint32_t module, std::uint32_t of_images) {
  proto::Image image;
  image.set_frame(frame);
  image.set_module(module);
  image.set_width_px(1);
  image.set_height_px(1);
  image.set_of_images(of_images);
  return image;
}

// Four bytes that name frame and module.
inline wire::Payload pixel_of(std::uint64_t frame, std::uint32_t module) {
  return std::make_shared<const std::string>(std::string{char(frame), char(frame >> 8), char(module), 'p'});
}

}  // namespace lfd::display
