// Made colour calibrations.
#include "calibration/make_color.h"

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>

#include "base/log.h"
#include "calibration/random.h"

namespace lfd {
namespace {

// Takes away the last digits, in which the mathematics libraries of machines differ.
double rounded(double value) { return std::round(value * 1e12) / 1e12; }

// The image is brightest near its middle; there the gain takes away what the farthest corner lacks.
GainMap made_gain(Random& random) {
  GainMap map{9, 7, {}};
  const glm::dvec2 middle(0.5 + 0.05 * random.normal(), 0.5 + 0.05 * random.normal());
  const double in_middle = 0.85 + 0.15 * random.unit();
  glm::dvec3 level;
  for (int c = 0; c < 3; ++c) level[c] = 0.95 + 0.05 * random.unit();
  const double farthest = std::hypot(std::max(middle.x, 1 - middle.x), std::max(middle.y, 1 - middle.y));
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.columns; ++column) {
      const double x = column / (map.columns - 1.0) - middle.x, y = row / (map.rows - 1.0) - middle.y;
      const double gain = in_middle + (1 - in_middle) * (x * x + y * y) / (farthest * farthest);
      map.node.emplace_back(rounded(gain * level.x), rounded(gain * level.y), rounded(gain * level.z));
    }
  }
  return map;
}

// No entry is negative and no row is more than 1: all colours of the display, and its white, can be shown.
glm::dmat3 made_matrix(Random& random) {
  glm::dmat3 m(0);
  for (int row = 0; row < 3; ++row) {
    const double a = rounded(0.04 * random.unit()), b = rounded(0.04 * random.unit());
    m[(row + 1) % 3][row] = a;
    m[(row + 2) % 3][row] = b;
    m[row][row] = rounded(1 - a - b);
  }
  return m;
}

}  // namespace

DisplayCalibration colored(const DisplayCalibration& display, std::uint64_t seed) {
  DisplayCalibration result = display;
  result.name += fmt::format("-color-{}", seed);
  Random random(seed);
  for (ModuleCalibration& module : result.modules) {
    ColorCalibration color;
    color.gain = made_gain(random);
    color.device_from_display = made_matrix(random);
    for (TransferCurve& curve : color.curve) curve = GammaCurve{rounded(2.0 + 0.4 * random.unit())};
    module.color = std::move(color);
  }
  return result;
}

}  // namespace lfd
