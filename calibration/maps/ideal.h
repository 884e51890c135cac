// The ideal map: the screen rectangle fills the image.
#pragma once

#include <optional>

#include "calibration/spaces/pixel.h"
#include "calibration/spaces/spaces.h"

namespace lfd {

struct IdealMap {
  bool operator==(const IdealMap&) const = default;
};

// The screen's size in metres; it spans +-width/2 and +-height/2 about the origin.
struct ScreenSize {
  double width_m = 0, height_m = 0;
  bool operator==(const ScreenSize&) const = default;
};

// On the screen, its border included.
constexpr bool contains(ScreenSize size, ScreenPoint s) {
  return 2 * s.x >= -size.width_m && 2 * s.x <= size.width_m && 2 * s.y >= -size.height_m && 2 * s.y <= size.height_m;
}

inline PixelPoint image_from_screen(const IdealMap&, ScreenSize screen, ImageSize image, ScreenPoint s) {
  return {(s.x / screen.width_m + 0.5) * image.width, (0.5 - s.y / screen.height_m) * image.height};
}

inline ScreenPoint screen_from_image(const IdealMap&, ScreenSize screen, ImageSize image, PixelPoint p) {
  return {(p.x / image.width - 0.5) * screen.width_m, (0.5 - p.y / image.height) * screen.height_m};
}

}  // namespace lfd
