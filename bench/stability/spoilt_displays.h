// Small displays of every kind, to be spoilt field by field.
#pragma once

#include <string>
#include <vector>

#include "calibration/display.h"

namespace lfd::bench {

// Two modules of 16 x 12 pixels with ideal maps.
DisplayCalibration plain_display();

// Gains, a black level, mixed primaries, and a curve of each kind.
ColorCalibration measured_color();

struct NamedDisplay {
  std::string kind;
  DisplayCalibration display;
};

// One for each kind of map, of diffuser and of screen, and one with a colour calibration; all valid.
std::vector<NamedDisplay> spoilable_displays();

}  // namespace lfd::bench
