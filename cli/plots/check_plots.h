// Pictures of a checked calibration, for people.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "base/result.h"
#include "calibration/check/check.h"

namespace lfd {

// Writes overview.svg and coverage.svg, and of one module warp-, condition- and round-trip-module-NNN.svg and, of a
// grid, grid-module-NNN.svg. Without `module` it is worst_module(). Errors: files that cannot be written.
Status write_check_plots(const std::filesystem::path& folder, const DisplayCalibration& display,
                         const CalibrationReport& report, std::optional<int> module);

// The module that has folded or mirrors most, then covers least, then has the worst condition; the first of equals.
int worst_module(const CalibrationReport& report);

namespace plots {

// Each is a whole SVG file. `module` is a number of the display's.

// Emitters, screen and observers from above; angles between neighbouring emitters; the spot over the depth.
std::string overview(const DisplayCalibration& display, const CalibrationReport& report);

// How many modules light each place of the screen.
std::string coverage(const DisplayCalibration& display, const CalibrationReport& report);

// How far the map moves pixels against the ideal one, as arrows.
std::string warp(const DisplayCalibration& display, int module);

// Condition numbers behind, on and before the screen.
std::string condition(const DisplayCalibration& display, const CalibrationReport& report, int module);

// Round trips over the image, and where there is no map.
std::string round_trip(const DisplayCalibration& display, int module);

// The nodes of a grid on the screen, with holes and folds. The module's map is a GridMap.
std::string grid(const DisplayCalibration& display, int module);

}  // namespace plots
}  // namespace lfd
