// A measured map from the screen to the image as the GPU can look it up: a homography and a table of what it misses.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "calibration/display.h"

namespace lfd {

// How far, in pixels, a table should be from the map that it stands for, and how far it may be, in cells whose corners
// were all measured. At holes, folds and the border of what was measured a table ends in straight lines; there it is
// said how far it is off, and warned of beyond the second number.
inline constexpr double kTableTolerance_px = 0.005, kMostTableError_px = 0.1;

// image(s) = base s + residual(s), the residual bilinear between nodes over the screen and a margin around it, and that
// of the border beyond. Near holes, folds and the border of what was measured, nodes are continued in straight lines:
// corners of triangles need a place there too.
struct WarpTable {
  glm::dmat3 image_from_screen{1.0};  // the base, column-major
  glm::dvec2 low{0.0}, cell{1.0};     // metres: the first node, and from node to node
  int columns = 0, rows = 0;
  std::vector<glm::vec2> residual_px;  // row by row upward, as s and y grow
  // Largest distances from the map, in pixels, measured in the middles of cells and of their sides, wherever the map
  // has a pixel: in cells whose corners have one too, and in those at holes, folds and the border.
  double error_px = 0, border_error_px = 0;

  // Absent behind the base's horizon.
  std::optional<glm::dvec2> at(glm::dvec2 s) const;
};

// The table with 2^level + 1 columns for a module with a GridMap; rows in proportion to the screen. Levels 4 to 9.
WarpTable warp_table(const DisplayCalibration& display, const ModuleCalibration& module, int level);

// The coarsest level at which every module that has a GridMap is within the tolerance; the finest, where none is. 4
// where no module has one.
struct WarpTables {
  int level = 4;
  std::vector<std::optional<WarpTable>> of_module;  // in the order of `modules`; absent for other maps

  int columns() const { return (1 << level) + 1; }
};
// level: taken instead, where not 0.
WarpTables warp_tables(const DisplayCalibration& display, const std::vector<std::uint32_t>& modules, int level = 0);

// A line for each module whose table misses the tolerance, and by how much. Error: one is off by more than
// kMostTableError_px, so that what it stands for cannot be drawn.
Result<std::vector<std::string>> warnings_of(const WarpTables& tables, const std::vector<std::uint32_t>& modules);

}  // namespace lfd
