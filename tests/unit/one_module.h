// A display of one ideal module, for tests of the calibration check.
#pragma once

#include "calibration/display.h"

namespace lfd {

inline DisplayCalibration one_module() {
  DisplayCalibration display;
  display.screen = {2, 1};
  display.image = {200, 100};
  display.optics = {Diffuser::kLinear, 0.5, 4};
  display.angular_scattering_rad = 0.1;
  display.modules = {{{0.2, -0.3, -2}, IdealMap{}}};
  return display;
}

}  // namespace lfd
