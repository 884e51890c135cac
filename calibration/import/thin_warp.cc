// Grids of more and more nodes, each held against the warp.
#include "calibration/import/thin_warp.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/check.h"

namespace lfd {
namespace {

constexpr int kFewestNodes = 33;

// Between centres, linearly; a hole where a cell that counts is one.
ScreenPoint interpolated(const DenseWarp& warp, double x, double y) {
  const auto column = static_cast<std::size_t>(x), row = static_cast<std::size_t>(y);
  const double a = x - std::floor(x), b = y - std::floor(y);
  ScreenPoint sum;
  for (const auto& [i, j, weight] : {std::tuple{0U, 0U, (1 - a) * (1 - b)}, std::tuple{1U, 0U, a * (1 - b)},
                                     std::tuple{0U, 1U, (1 - a) * b}, std::tuple{1U, 1U, a * b}}) {
    if (weight == 0) continue;
    const ScreenPoint& s = warp.points[(row + j) * static_cast<std::size_t>(warp.width) + column + i];
    sum = {sum.x + weight * s.x, sum.y + weight * s.y};
  }
  return sum;
}

GridNodes nodes_of(const DenseWarp& warp, int most_nodes) {
  GridNodes nodes;
  nodes.columns = std::min(warp.width, most_nodes);
  nodes.rows = std::min(warp.height, most_nodes);
  const double width_px = static_cast<double>(warp.image.width) / warp.width,
               height_px = static_cast<double>(warp.image.height) / warp.height;
  const auto stride = [](int cells, int count) { return count < 2 ? 1.0 : (cells - 1.0) / (count - 1.0); };
  const double across = stride(warp.width, nodes.columns), down = stride(warp.height, nodes.rows);
  nodes.first_u_px = 0.5 * width_px;
  nodes.first_v_px = 0.5 * height_px;
  nodes.step_u_px = across * width_px;
  nodes.step_v_px = down * height_px;
  nodes.node.reserve(static_cast<std::size_t>(nodes.columns) * static_cast<std::size_t>(nodes.rows));
  for (int row = 0; row < nodes.rows; ++row) {
    for (int column = 0; column < nodes.columns; ++column) {
      nodes.node.push_back(
          interpolated(warp, std::min(column * across, warp.width - 1.0), std::min(row * down, warp.height - 1.0)));
    }
  }
  return nodes;
}

// Metres of the screen to a pixel of the image at a cell: the smaller of those along u and v; NaN beside holes.
double pixel_m(const DenseWarp& warp, int column, int row) {
  const auto between = [&](int columns, int rows, double cell_px) {
    const int low_column = std::max(column - columns, 0), high_column = std::min(column + columns, warp.width - 1);
    const int low_row = std::max(row - rows, 0), high_row = std::min(row + rows, warp.height - 1);
    const auto at = [&](int i, int j) {
      return warp
          .points[static_cast<std::size_t>(j) * static_cast<std::size_t>(warp.width) + static_cast<std::size_t>(i)];
    };
    const ScreenPoint from = at(low_column, low_row), to = at(high_column, high_row);
    return std::hypot(to.x - from.x, to.y - from.y) / (cell_px * (high_column - low_column + high_row - low_row));
  };
  const double along_u = between(1, 0, static_cast<double>(warp.image.width) / warp.width);
  const double along_v = between(0, 1, static_cast<double>(warp.image.height) / warp.height);
  return std::isnan(along_u) || along_v < along_u ? along_v : along_u;
}

ThinningLoss loss_of(const DenseWarp& warp, const GridMap& map) {
  std::vector<double> distances_px;
  distances_px.reserve(warp.points.size());
  std::size_t changed = 0;
  for (int row = 0; row < warp.height; ++row) {
    for (int column = 0; column < warp.width; ++column) {
      const ScreenPoint& exact = warp.points[static_cast<std::size_t>(row) * static_cast<std::size_t>(warp.width) +
                                             static_cast<std::size_t>(column)];
      const auto got = screen_from_image(
          map, {(column + 0.5) * warp.image.width / warp.width, (row + 0.5) * warp.image.height / warp.height});
      if (got.has_value() == std::isnan(exact.x)) {
        ++changed;
      } else if (got) {
        const double distance_px = std::hypot(got->x - exact.x, got->y - exact.y) / pixel_m(warp, column, row);
        if (std::isfinite(distance_px)) distances_px.push_back(distance_px);  // beside holes a pixel has no size
      }
    }
  }
  ThinningLoss loss;
  loss.holes_changed = static_cast<double>(changed) / static_cast<double>(warp.points.size());
  if (distances_px.empty()) return loss;
  const auto middle = distances_px.begin() + static_cast<std::ptrdiff_t>(distances_px.size() / 2);
  std::ranges::nth_element(distances_px, middle);
  loss.median_px = *middle;
  loss.max_px = *std::ranges::max_element(distances_px);
  return loss;
}

}  // namespace

Result<ThinnedWarp> thinned(const DenseWarp& warp, const ThinningWish& wish) {
  LFD_CHECK(wish.most_nodes >= 2, "a grid map needs two nodes a side");
  for (int nodes = std::min(kFewestNodes, wish.most_nodes);; nodes = std::min(2 * nodes - 1, wish.most_nodes)) {
    const bool is_whole = nodes >= warp.width && nodes >= warp.height;
    LFD_TRY(GridMap map, GridMap::make(nodes_of(warp, nodes)));
    if (is_whole) return ThinnedWarp{std::move(map), {}};
    const ThinningLoss loss = loss_of(warp, map);
    if (loss.max_px <= wish.tolerance_px || nodes == wish.most_nodes) return ThinnedWarp{std::move(map), loss};
  }
}

}  // namespace lfd
