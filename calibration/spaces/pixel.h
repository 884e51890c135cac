// The pixel convention, said once: the first pixel covers [0, 1) and its centre is 0.5; row 0 is the top.
#pragma once

#include <cmath>

#include "calibration/spaces/spaces.h"

namespace lfd {

struct ImageSize {
  int width = 0, height = 0;
  bool operator==(const ImageSize&) const = default;
};

struct PixelIndex {
  int column = 0, row = 0;
  bool operator==(const PixelIndex&) const = default;
};

constexpr PixelPoint centre_of(PixelIndex i) { return {i.column + 0.5, i.row + 0.5}; }

inline PixelIndex pixel_at(PixelPoint p) {
  return {static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y))};
}

// Inside the image, its border included.
constexpr bool contains(ImageSize size, PixelPoint p) {
  return p.x >= 0 && p.y >= 0 && p.x <= size.width && p.y <= size.height;
}

}  // namespace lfd
