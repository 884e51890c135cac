// Colour calibrations as measured projectors have them.
#pragma once

#include <cstdint>

#include "calibration/display.h"

namespace lfd {

// The same display with a colour calibration for every module: corners up to 15 % dimmer than the middle, which gains
// of 0.8 to 1 even out; a gamma of 2.0 to 2.4 per channel; primaries up to 8 % off those of the display, always beyond
// them, so that every colour can be shown. No black level. Colour calibrations that are there are replaced. Equal seeds
// give equal displays.
DisplayCalibration colored(const DisplayCalibration& display, std::uint64_t seed);

}  // namespace lfd
