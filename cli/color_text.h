// The colour calibrations of a display in one line.
#pragma once

#include <string>

#include "calibration/display.h"

namespace lfd {

// "8 of 8 modules corrected: gain 0.81 to 1, black level 0, gamma 2.03 to 2.39"; "sRGB" where no module has one.
std::string color_text(const DisplayCalibration& display);

}  // namespace lfd
