// Measured grids that the suite spoils.
#pragma once

#include "calibration/maps/grid.h"

namespace lfd::bench {

// 17 x 13 nodes over the image and a screen of 0.4 x 0.3 m, bent smoothly.
GridNodes bent_nodes(ImageSize image);

ScreenPoint& node(GridNodes& nodes, int column, int row);

// Each of them changes nodes of bent_nodes().
GridNodes mirrored(GridNodes nodes);
GridNodes folded(GridNodes nodes);                        // turns back at 0.13 m on either side
GridNodes with_holes_at_border(GridNodes nodes);          // the first row, the last column
GridNodes with_node(GridNodes nodes, ScreenPoint value);  // column 8, row 6, in the middle

}  // namespace lfd::bench
