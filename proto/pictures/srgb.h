// The sRGB transfer function of bytes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/srgb.h"

namespace lfd {

inline std::uint8_t srgb8_from_linear(double value) {
  return static_cast<std::uint8_t>(std::lround(255 * srgb_from_linear(std::clamp(value, 0.0, 1.0))));
}

inline const std::array<float, 256>& linear_from_srgb8() {
  static const auto table = [] {
    std::array<float, 256> values{};
    for (int i = 0; i < 256; ++i) values[i] = static_cast<float>(linear_from_srgb(i / 255.0));
    return values;
  }();
  return table;
}

}  // namespace lfd
