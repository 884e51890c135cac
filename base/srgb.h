// The sRGB transfer function (IEC 61966-2-1), for values from 0 to 1.
#pragma once

#include <cmath>

namespace lfd {

inline double linear_from_srgb(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

inline double srgb_from_linear(double value) {
  return value <= 0.0031308 ? value * 12.92 : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
}

}  // namespace lfd
