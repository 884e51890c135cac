// Nodes of measured grids in files beside a calibration (Grid.file of proto/calibration.proto).
//
//   *.pfm   three channels (calibration/import/pfm.h): s, y, and a third that is ignored; float32
//   *.exr   channels s and y, or else R and G; others are ignored
//   *.csv   lines column,row,s,y (proto/grid_csv.h)
// Metres; one pixel a node, rows from the top, NaN where nothing was measured.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/result.h"
#include "calibration/maps/grid.h"
#include "proto/calibration.pb.h"

namespace lfd {

// Limits, checked before memory is taken. A file has at most kMaxGridSide nodes a side.
inline constexpr std::size_t kGridFileLimit_bytes = std::size_t{256} << 20;
inline constexpr std::size_t kMaxFileNodes = std::size_t{1} << 26;  // of all grid files of a calibration

// The nodes of a file, whose format its name's ending tells; places and steps are left as they are in GridNodes{}.
// Errors, a node_fault() among them, name the line ("7: s: ...") or the pixel ("pixel (3, 7): s: ...").
Result<GridNodes> parse_grid_file(std::string_view name, std::string_view content);

// Fills s and y of every grid that names a file, relative to `folder`, and clears the name. Columns and rows are the
// file's; where the grid says them too, they must agree. A path may not leave the folder. Errors name module, field and
// file: "module 3: grid: file: left.csv: 7: ...".
Status read_grid_files(proto::DisplayCalibration& message, const std::filesystem::path& folder);

enum class GridFileFormat { kPfm, kCsv };  // PFM rounds to float32

// Moves the nodes of every grid into a file "STEM-module-003.pfm" of `folder`, which the grid then names.
Status write_grid_files(proto::DisplayCalibration& message, const std::filesystem::path& folder,
                        const std::string& stem, GridFileFormat format);

}  // namespace lfd
