// Dense warps as grids of few nodes: how few is chosen by what the grid loses.
#pragma once

#include <vector>

#include "base/result.h"
#include "calibration/maps/grid.h"

namespace lfd {

// A point of the screen for each of width x height cells that share an image evenly, row by row from the top; NaN where
// a cell lights nothing.
struct DenseWarp {
  int width = 0, height = 0;
  ImageSize image;
  std::vector<ScreenPoint> points;
};

// A grid's distances from the warp at the centres of all cells that both have a point for, in pixels of the image as
// large as they are there; and the share of all cells that only one of them has a point for.
struct ThinningLoss {
  double median_px = 0, max_px = 0, holes_changed = 0;
};

struct ThinnedWarp {
  GridMap map;
  ThinningLoss loss;  // all 0 where every cell has a node of its own
};

struct ThinningWish {
  double tolerance_px = 0.1;  // of max_px
  int most_nodes = 257;       // along each side, >= 2
};

// Nodes from the first cell's centre to the last one's, linear between centres: 33 a side, doubled until the tolerance
// holds, or most_nodes. Errors: those of GridMap::make.
Result<ThinnedWarp> thinned(const DenseWarp& warp, const ThinningWish& wish);

}  // namespace lfd
