// Nodes moved and taken away.
#include "bench/stability/bent_grids.h"

#include <cmath>
#include <limits>

namespace lfd::bench {
namespace {

constexpr ScreenPoint kHole{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};

}  // namespace

GridNodes bent_nodes(ImageSize image) {
  GridNodes nodes{17, 13, 0, 0, image.width / 16.0, image.height / 12.0, {}};
  for (int row = 0; row < nodes.rows; ++row) {
    for (int column = 0; column < nodes.columns; ++column) {
      const PixelPoint p = nodes.place(column, row);
      const double s = (p.x / image.width - 0.5) * 0.4, y = (0.5 - p.y / image.height) * 0.3;
      nodes.node.push_back({s + 0.004 * std::sin(9 * y), y + 0.003 * std::sin(8 * s)});
    }
  }
  return nodes;
}

ScreenPoint& node(GridNodes& nodes, int column, int row) {
  return nodes.node[static_cast<std::size_t>(row * nodes.columns + column)];
}

GridNodes mirrored(GridNodes nodes) {
  for (auto& n : nodes.node) n.x = -n.x;
  return nodes;
}

GridNodes folded(GridNodes nodes) {
  for (auto& n : nodes.node) n.x = 0.15 * std::sin(12 * n.x);
  return nodes;
}

GridNodes with_holes_at_border(GridNodes nodes) {
  for (int i = 0; i < nodes.columns; ++i) node(nodes, i, 0) = kHole;
  for (int i = 0; i < nodes.rows; ++i) node(nodes, nodes.columns - 1, i) = kHole;
  return nodes;
}

GridNodes with_node(GridNodes nodes, ScreenPoint value) {
  node(nodes, 8, 6) = value;
  return nodes;
}

}  // namespace lfd::bench
