// Making them.
#include "bench/stability/spoilt_displays.h"

#include "calibration/make.h"
#include "rendernode/geometry/clip_map.h"

namespace lfd::bench {
namespace {

template <class T>
T unwrapped(Result<T> result) {
  LFD_CHECK(result, result.error().message());
  return *std::move(result);
}

}  // namespace

DisplayCalibration plain_display() {
  DisplayCalibration display{"plain", {0.4, 0.3}, {16, 12}, {Diffuser::kLinear, 0.05, 0.8, 0, false}, 0.05, {}};
  display.modules.push_back({{-0.1, 0.02, -0.6}, IdealMap{}});
  display.modules.push_back({{0.1, 0.02, -0.6}, IdealMap{}});
  return display;
}

ColorCalibration measured_color() {
  ColorCalibration color;
  color.gain = {2, 2, {{0.8, 0.9, 1}, {1, 0.9, 0.8}, {0.7, 0.7, 0.7}, {1, 1, 1}}};
  color.black_level = {0.01, 0.02, 0.03};
  color.device_from_display = {{0.9, 0.05, 0.02}, {0.04, 0.95, 0.03}, {0.03, 0.02, 0.97}};
  color.curve = {GammaCurve{2.2}, SrgbCurve{}, TableCurve{{0, 0.3, 0.6, 1}}};
  return color;
}

std::vector<NamedDisplay> spoilable_displays() {
  const DisplayCalibration ideal = plain_display();
  DisplayCalibration homography = ideal;
  homography.optics.diffuser = Diffuser::kConical;
  for (auto& module : homography.modules) {
    glm::dmat3 h = ideal_homography(ideal.screen, ideal.image);
    h[0].z = 0.05;
    h[0].y = h[1].x = 0.5;
    module.map = HomographyMap{h};
  }
  DisplayCalibration color = ideal;
  color.modules[0].color = measured_color();
  return {{"ideal", ideal},
          {"colour", color},
          {"homography", homography},
          {"pinhole", perturbed(ideal, 1)},
          {"grid", unwrapped(measured(perturbed(ideal, 2), 5, 4, 0.2, 3))},
          {"curved", unwrapped(curved(perturbed(ideal, 4), 0.5, true))}};
}

}  // namespace lfd::bench
