// Measured grids as text: the line "column,row,s,y", then one line for each node, in any order; missing nodes are
// holes.
#pragma once

#include <string>
#include <string_view>

#include "base/result.h"
#include "calibration/maps/grid.h"

namespace lfd {

// Columns count from the left and rows from the top, from 0 to kMaxGridSide - 1; s and y are metres. The grid ends at
// the largest column and row. Errors name the line: "7: row: ...". Refuses nodes given twice and grids of which less
// than one node in 100 is given, so that a small file takes little memory.
Result<GridNodes> parse_grid_csv(std::string_view text);

// Nodes row by row, holes left out; every double survives.
std::string print_grid_csv(const GridNodes& nodes);

}  // namespace lfd
