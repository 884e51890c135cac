// The residuals of a fitted module over its image, for people.
#pragma once

#include <string>
#include <vector>

#include "calibration/display.h"

namespace lfd::plots {

// An observation: the pixel that was lit, and where its light lay on the screen.
struct SeenPoint {
  PixelPoint in_image;
  ScreenPoint on_screen;
  bool is_outlier = false;
};

// A whole SVG file: from each seen pixel an arrow toward where the module's map has its screen point, magnified as
// stated; outliers in their true length; crosses where the map has no answer. `module` is a number of the display's.
std::string residuals(const DisplayCalibration& display, int module, const std::vector<SeenPoint>& points);

}  // namespace lfd::plots
