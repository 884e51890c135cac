// Display calibrations as messages and as text files (schema: proto/calibration.proto).
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "base/result.h"
#include "calibration/display.h"
#include "proto/calibration.pb.h"
#include "proto/grid_files.h"

namespace lfd {

// Checks everything; errors name module and field: "module 3: pinhole: focal_u_px: 0 must be positive and finite".
Result<DisplayCalibration> read_calibration(const proto::DisplayCalibration& message);

// The message that read_calibration turns into an equal display.
proto::DisplayCalibration write_calibration(const DisplayCalibration& display);

// Errors name file, line, module and field: "wall.textproto:14: module 3: pinhole: focal_u_px: ...".
Result<DisplayCalibration> load_calibration(const std::filesystem::path& path);

// load_calibration of the file written gives an equal display. With `grids` the nodes of measured maps lie in files
// beside it (STEM-module-003.pfm); PFM rounds them to float32. Refuses more text than kTextFileLimit_bytes.
Status save_calibration(const std::filesystem::path& path, const DisplayCalibration& display,
                        std::optional<GridFileFormat> grids = std::nullopt);

// Equal calibrations, and in practice only they, have equal hashes (base/hash.h).
std::string calibration_hash(const DisplayCalibration& display);

}  // namespace lfd
