// Displays of every kind, at random, for the properties of the render node's geometry.
#pragma once

#include <array>
#include <random>

#include "calibration/make.h"

namespace lfd::testing_support {

using Random = std::mt19937_64;

inline double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

enum class MapKind { kIdeal, kHomography, kPinhole };
inline constexpr std::array kMapKinds{MapKind::kIdeal, MapKind::kHomography, MapKind::kPinhole};
inline constexpr std::array kDiffusers{Diffuser::kLinear, Diffuser::kConical};

// Three modules of 640 x 480 pixels before a screen of 1.6 x 0.9 m: emitters anywhere behind it, observers of any
// height.
inline DisplayCalibration random_display(Diffuser diffuser, MapKind kind, Random& random) {
  DisplayCalibration display{"random", {1.6, 0.9}, {640, 480}, {}, 0.05, {}};
  display.optics = {diffuser, uniform(random, -0.3, 0.3), uniform(random, 2, 4)};
  for (int k = 0; k < 3; ++k) {
    const Emitter emitter{uniform(random, -1, 1), uniform(random, -0.6, 0.6), uniform(random, -2.5, -1.5)};
    display.modules.push_back({emitter, IdealMap{}});
  }
  if (kind == MapKind::kPinhole) return perturbed(display, random());
  if (kind == MapKind::kIdeal) return display;
  for (auto& module : display.modules) {
    const auto off = [&](double size) { return uniform(random, -size, size); };
    // The ideal map, turned, sheared and tilted a little.
    const glm::dmat3 ideal{400, 0, 0, 0, -480 / 0.9, 0, 320, 240, 1};
    const glm::dmat3 error{1 + off(0.02), off(0.02), off(2e-5), off(0.02), 1 + off(0.02), off(2e-5), off(5), off(5), 1};
    module.map = HomographyMap{error * ideal};
  }
  return display;
}

}  // namespace lfd::testing_support
