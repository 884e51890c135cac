// A measured map: nodes (u, v) -> (s, y), interpolated smoothly; its inverse by solving.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "calibration/spaces/pixel.h"
#include "calibration/spaces/spaces.h"

namespace lfd {

// Node (i, j), column i from the left and row j from the top, lies at (first_u_px + i step_u_px, first_v_px + j
// step_v_px) of the image and lights the screen point node[j * columns + i], in metres; NaN where nothing was measured.
struct GridNodes {
  int columns = 0, rows = 0;
  double first_u_px = 0, first_v_px = 0;
  double step_u_px = 1, step_v_px = 1;  // > 0
  std::vector<ScreenPoint> node;

  PixelPoint place(int column, int row) const {
    return {first_u_px + column * step_u_px, first_v_px + row * step_v_px};
  }
  const ScreenPoint& at(int column, int row) const {
    return node[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)];
  }
  // Holes equal holes.
  bool operator==(const GridNodes& other) const;
};

inline constexpr int kMaxGridSide = 4096;         // nodes
inline constexpr double kMaxScreenPlace_m = 1e4;  // beyond this a node is a mistake

// What is wrong with a node.
struct NodeFault {
  int column = 0, row = 0;
  char coordinate = 's';  // that shows it: s or y
  std::string what;
};

// The first, row by row: a node that is infinite, half a hole or beyond kMaxScreenPlace_m, or at the same place as its
// neighbour. node has columns x rows of them.
std::optional<NodeFault> node_fault(const GridNodes& nodes);

// Immutable; copies share the nodes.
class GridMap {
 public:
  // Errors name the field, of nodes with their number ("s 17: ..."): fewer than 2 x 2 nodes or more than kMaxGridSide a
  // side, another number of nodes than columns x rows, steps that are not positive and finite, a node_fault(), no cell
  // with all four corners.
  static Result<GridMap> make(GridNodes nodes);

  const GridNodes& nodes() const;

  // Share of the cells between nodes that have all four corners.
  double complete_share() const;
  // Whether a complete cell has folded: somewhere in it the map is mirrored against most cells' middles, or all but
  // flat; that no place of it is, is proven and not sampled (fold.h). Of the cell right of and below the node; false
  // where it lacks a corner.
  bool has_folded(int column, int row) const;
  // Share of the complete cells that have folded. Looks at every cell.
  double folded_share() const;

  bool operator==(const GridMap& other) const { return nodes() == other.nodes(); }

  struct Prepared;
  const Prepared& prepared() const { return *prepared_; }

 private:
  explicit GridMap(std::shared_ptr<const Prepared> prepared) : prepared_(std::move(prepared)) {}

  std::shared_ptr<const Prepared> prepared_;
};

// By Catmull-Rom over 4 x 4 nodes: continuous with its first derivative away from holes, continuous beside them (a
// missing neighbour is put where the line through the next two goes). Absent beside the nodes, in cells that lack a
// corner, and where the grid has folded.
std::optional<ScreenPoint> screen_from_image(const GridMap& map, PixelPoint p);

// Its inverse, to rounding. Absent where no point of the grid that has not folded lights `s`; how sure that is:
// invert() in bicubic_patch.h. Where unfolded parts overlap, the first in the order of rows and columns counts.
std::optional<PixelPoint> image_from_screen(const GridMap& map, ScreenPoint s);

}  // namespace lfd
