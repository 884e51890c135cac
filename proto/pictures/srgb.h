// The sRGB transfer function (IEC 61966-2-1), for values from 0 to 1.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace lfd {

inline double linear_from_srgb(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

inline double srgb_from_linear(double value) {
  return value <= 0.0031308 ? value * 12.92 : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
}

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
