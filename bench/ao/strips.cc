// Pixels.
#include "bench/ao/strips.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.h"

namespace lfd::bench {
namespace {

using Pixel = std::array<std::uint8_t, 4>;

constexpr Pixel kNoSurface{0, 48, 0, 255};
constexpr float kFull = 0.25F;

Pixel grey(float open) {
  if (open < 0) return kNoSurface;
  const auto level = static_cast<std::uint8_t>(std::lround(255 * std::clamp(open, 0.0F, 1.0F)));
  return {level, level, level, 255};
}

Pixel difference_of(float reference, float method) {
  if (reference < 0 || method < 0) return kNoSurface;
  const float off = std::clamp((method - reference) / kFull, -1.0F, 1.0F);
  const auto faded = static_cast<std::uint8_t>(std::lround(128 * (1 - std::abs(off))));
  const auto strong = static_cast<std::uint8_t>(std::lround(128 + 127 * std::abs(off)));
  return off < 0 ? Pixel{strong, faded, faded, 255} : Pixel{faded, faded, strong, 255};
}

}  // namespace

Picture8 strip_of(const Openness& reference, const Openness& method) {
  LFD_CHECK(reference.size == method.size, "pictures of one size are compared");
  const int width = reference.size.width, height = reference.size.height;
  Picture8 strip = black_picture(3 * width, height);
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const std::size_t i = static_cast<std::size_t>(row) * width + column;
      const float r = reference.value[i], m = method.value[i];
      for (const auto& [third, pixel] : {std::pair{0, grey(r)}, {1, grey(m)}, {2, difference_of(r, m)}})
        std::ranges::copy(
            pixel, strip.rgba.begin() + 4 * (static_cast<std::ptrdiff_t>(row) * 3 * width + third * width + column));
    }
  }
  return strip;
}

}  // namespace lfd::bench
