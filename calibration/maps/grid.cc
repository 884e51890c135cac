// Cells of measured grids, and where to look for a screen point among them.
#include "calibration/maps/grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include "calibration/limits.h"
#include "calibration/maps/bicubic_patch.h"
#include "calibration/maps/fold.h"

namespace lfd {
namespace {

bool is_hole(const ScreenPoint& s) { return std::isnan(s.x) || std::isnan(s.y); }

glm::dvec2 vec(const ScreenPoint& s) { return {s.x, s.y}; }

// Absent for holes and beside the grid.
std::optional<glm::dvec2> node_at(const GridNodes& nodes, int column, int row) {
  if (column < 0 || row < 0 || column >= nodes.columns || row >= nodes.rows) return std::nullopt;
  const ScreenPoint& s = nodes.at(column, row);
  if (is_hole(s)) return std::nullopt;
  return vec(s);
}

bool is_complete(const GridNodes& nodes, int column, int row) {
  return node_at(nodes, column, row) && node_at(nodes, column + 1, row) && node_at(nodes, column, row + 1) &&
         node_at(nodes, column + 1, row + 1);
}

// The patch of a complete cell. A missing neighbour of an edge is put on the line through the edge's two nodes, by a
// rule that looks along that edge only: the cells on both sides of it agree.
BicubicPatch patch_of_cell(const GridNodes& nodes, int column, int row) {
  std::array<glm::dvec2, 16> p;
  const auto at = [&](int i, int j) -> glm::dvec2& { return p[static_cast<std::size_t>(4 * (j + 1) + i + 1)]; };
  const auto real = [&](int i, int j) { return node_at(nodes, column + i, row + j); };
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) at(i, j) = *real(i, j);
  }
  for (int k = 0; k < 2; ++k) {
    at(-1, k) = real(-1, k).value_or(2.0 * at(0, k) - at(1, k));
    at(2, k) = real(2, k).value_or(2.0 * at(1, k) - at(0, k));
    at(k, -1) = real(k, -1).value_or(2.0 * at(k, 0) - at(k, 1));
    at(k, 2) = real(k, 2).value_or(2.0 * at(k, 1) - at(k, 0));
  }
  for (const int j : {-1, 2}) {
    at(-1, j) = real(-1, j).value_or(2.0 * at(0, j) - at(1, j));
    at(2, j) = real(2, j).value_or(2.0 * at(1, j) - at(0, j));
  }
  return patch_between(p);
}

std::optional<NodeFault> fault_at(const GridNodes& nodes, int column, int row) {
  const ScreenPoint& s = nodes.at(column, row);
  const auto fault = [&](char coordinate, std::string what) { return NodeFault{column, row, coordinate, what}; };
  if (std::isnan(s.x) != std::isnan(s.y))
    return fault(std::isnan(s.x) ? 's' : 'y', "is missing, the other coordinate is there: both or none");
  if (is_hole(s)) return std::nullopt;
  for (const auto& [coordinate, value] : {std::pair{'s', s.x}, std::pair{'y', s.y}}) {
    if (!(std::abs(value) <= kMaxScreenPlace_m))
      return fault(coordinate, fmt::format("{:g} m; at most {:g} m is possible", value, kMaxScreenPlace_m));
  }
  for (const auto& [i, j] : {std::pair{column + 1, row}, std::pair{column, row + 1}}) {
    const auto neighbour = node_at(nodes, i, j);
    if (neighbour && *neighbour == vec(s))
      return fault('s', fmt::format("at the same place of the screen as column {}, row {}", i, j));
  }
  return std::nullopt;
}

Status check_nodes(const GridNodes& nodes) {
  for (const auto& [name, count] : {std::pair{"columns", nodes.columns}, std::pair{"rows", nodes.rows}}) {
    if (count < 2 || count > kMaxGridSide) {
      return Error(fmt::format("{}: {}; 2 to {} are possible", name, count, kMaxGridSide));
    }
  }
  const auto wanted = static_cast<std::size_t>(nodes.columns) * static_cast<std::size_t>(nodes.rows);
  if (nodes.node.size() != wanted) {
    return Error(fmt::format("{} nodes; columns x rows are {}", nodes.node.size(), wanted));
  }
  for (const auto& [name, value] : {std::pair{"step_u_px", nodes.step_u_px}, std::pair{"step_v_px", nodes.step_v_px}}) {
    if (!(value > 0) || !std::isfinite(value))
      return Error(fmt::format("{}: {} must be positive and finite", name, value));
    LFD_TRY_STATUS(check_magnitude(name, value, kGridStep_px));
  }
  for (const auto& [name, value] :
       {std::pair{"first_u_px", nodes.first_u_px}, std::pair{"first_v_px", nodes.first_v_px}}) {
    if (!std::isfinite(value)) return Error(fmt::format("{}: must be finite", name));
    LFD_TRY_STATUS(check_magnitude(name, value, kPlace_px));
  }
  if (const auto fault = node_fault(nodes)) {
    return Error(fmt::format("{} {}: column {}, row {}: {}", fault->coordinate,
                             fault->row * nodes.columns + fault->column, fault->column, fault->row, fault->what));
  }
  return {};
}

}  // namespace

// Complete cells are found by their place on the screen through buckets: a raster over the bounds of all cells.
struct GridMap::Prepared {
  struct Cell {
    int column = 0, row = 0;
    Box2 bounds;
  };

  GridNodes nodes;
  std::vector<Cell> cells;  // the complete ones
  double orientation = -1;  // sign of the Jacobian of (s, y) by (u, v) in most cells; v grows downward, y upward
  Box2 bounds;
  int side = 1;                           // buckets along each axis
  std::vector<std::uint32_t> first_cell;  // of each bucket, in `listed`; one more at the end
  std::vector<std::uint32_t> listed;      // indices of cells

  glm::ivec2 bucket_of(glm::dvec2 s) const {
    const glm::dvec2 share = (s - bounds.low) / glm::max(bounds.high - bounds.low, glm::dvec2(1e-300));
    return glm::clamp(glm::ivec2(share * static_cast<double>(side)), glm::ivec2(0), glm::ivec2(side - 1));
  }
  void find_cells();
  void fill_buckets();
};

void GridMap::Prepared::find_cells() {
  std::size_t negative = 0;
  for (int row = 0; row + 1 < nodes.rows; ++row) {
    for (int column = 0; column + 1 < nodes.columns; ++column) {
      if (!is_complete(nodes, column, row)) continue;
      const BicubicPatch patch = patch_of_cell(nodes, column, row);
      cells.push_back({column, row, bounds_of(patch)});
      if (glm::determinant(patch.derivative(glm::dvec2(0.5))) < 0) ++negative;
    }
  }
  orientation = 2 * negative >= cells.size() ? -1 : 1;
}

void GridMap::Prepared::fill_buckets() {
  bounds = cells.front().bounds;
  for (const Cell& cell : cells) {
    bounds.low = glm::min(bounds.low, cell.bounds.low);
    bounds.high = glm::max(bounds.high, cell.bounds.high);
  }
  // As many buckets as cells; fewer where cells are so large that each would be listed many times.
  const std::size_t most_listed = 16 * cells.size() + 64;
  for (side = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(cells.size()))));; side /= 2) {
    std::size_t count = 0;
    for (const Cell& cell : cells) {
      const glm::ivec2 size = bucket_of(cell.bounds.high) - bucket_of(cell.bounds.low) + 1;
      count += static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
    }
    if (count <= most_listed || side <= 1) break;
  }
  const auto for_buckets = [this](const Cell& cell, auto visit) {
    const glm::ivec2 low = bucket_of(cell.bounds.low), high = bucket_of(cell.bounds.high);
    for (int y = low.y; y <= high.y; ++y) {
      for (int x = low.x; x <= high.x; ++x)
        visit(static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + static_cast<std::size_t>(x));
    }
  };
  first_cell.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) + 1, 0);
  for (const Cell& cell : cells) for_buckets(cell, [&](std::size_t bucket) { ++first_cell[bucket + 1]; });
  for (std::size_t i = 1; i < first_cell.size(); ++i) first_cell[i] += first_cell[i - 1];
  listed.resize(first_cell.back());
  std::vector<std::uint32_t> next(first_cell.begin(), first_cell.end() - 1);
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    for_buckets(cells[i], [&](std::size_t bucket) { listed[next[bucket]++] = i; });
  }
}

bool GridNodes::operator==(const GridNodes& other) const {
  const auto same = [](const ScreenPoint& a, const ScreenPoint& b) { return a == b || (is_hole(a) && is_hole(b)); };
  return columns == other.columns && rows == other.rows && first_u_px == other.first_u_px &&
         first_v_px == other.first_v_px && step_u_px == other.step_u_px && step_v_px == other.step_v_px &&
         std::ranges::equal(node, other.node, same);
}

std::optional<NodeFault> node_fault(const GridNodes& nodes) {
  for (int row = 0; row < nodes.rows; ++row) {
    for (int column = 0; column < nodes.columns; ++column) {
      if (auto fault = fault_at(nodes, column, row)) return fault;
    }
  }
  return std::nullopt;
}

Result<GridMap> GridMap::make(GridNodes nodes) {
  LFD_TRY_STATUS(check_nodes(nodes));
  auto prepared = std::make_shared<Prepared>();
  prepared->nodes = std::move(nodes);
  prepared->find_cells();
  if (prepared->cells.empty()) return Error("no cell of the grid has all four corners");
  prepared->fill_buckets();
  return GridMap(std::move(prepared));
}

const GridNodes& GridMap::nodes() const { return prepared_->nodes; }

double GridMap::complete_share() const {
  const auto all = static_cast<double>(nodes().columns - 1) * (nodes().rows - 1);
  return static_cast<double>(prepared_->cells.size()) / all;
}

bool GridMap::has_folded(int column, int row) const {
  return is_complete(nodes(), column, row) &&
         !keeps_orientation(patch_of_cell(nodes(), column, row), prepared_->orientation);
}

double GridMap::folded_share() const {
  const auto& cells = prepared_->cells;
  const auto folded =
      std::ranges::count_if(cells, [this](const Prepared::Cell& cell) { return has_folded(cell.column, cell.row); });
  return static_cast<double>(folded) / static_cast<double>(cells.size());
}

std::optional<ScreenPoint> screen_from_image(const GridMap& map, PixelPoint p) {
  const GridMap::Prepared& grid = map.prepared();
  const GridNodes& nodes = grid.nodes;
  const double x = (p.x - nodes.first_u_px) / nodes.step_u_px, y = (p.y - nodes.first_v_px) / nodes.step_v_px;
  if (!(x >= 0 && x <= nodes.columns - 1 && y >= 0 && y <= nodes.rows - 1)) return std::nullopt;
  const int column = std::min(static_cast<int>(x), nodes.columns - 2),
            row = std::min(static_cast<int>(y), nodes.rows - 2);
  if (!is_complete(nodes, column, row)) return std::nullopt;
  const BicubicPatch patch = patch_of_cell(nodes, column, row);
  const glm::dvec2 ab(x - column, y - row);
  if (!(glm::determinant(patch.derivative(ab)) * grid.orientation > 0)) return std::nullopt;
  const glm::dvec2 s = patch.at(ab);
  return ScreenPoint{s.x, s.y};
}

std::optional<PixelPoint> image_from_screen(const GridMap& map, ScreenPoint s) {
  const GridMap::Prepared& grid = map.prepared();
  const glm::dvec2 target(s.x, s.y);
  if (!is_finite(s) || !grid.bounds.contains(target)) return std::nullopt;
  const glm::ivec2 at = grid.bucket_of(target);
  const auto bucket =
      static_cast<std::size_t>(at.y) * static_cast<std::size_t>(grid.side) + static_cast<std::size_t>(at.x);
  for (std::uint32_t i = grid.first_cell[bucket]; i < grid.first_cell[bucket + 1]; ++i) {
    const GridMap::Prepared::Cell& cell = grid.cells[grid.listed[i]];
    if (!cell.bounds.contains(target)) continue;
    const auto ab = invert(patch_of_cell(grid.nodes, cell.column, cell.row), target, grid.orientation);
    if (!ab) continue;
    const PixelPoint corner = grid.nodes.place(cell.column, cell.row);
    return PixelPoint{corner.x + ab->x * grid.nodes.step_u_px, corner.y + ab->y * grid.nodes.step_v_px};
  }
  return std::nullopt;
}

}  // namespace lfd
