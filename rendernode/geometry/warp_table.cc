// Fitting the base, filling the table, measuring its error.
#include "rendernode/geometry/warp_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "base/check.h"
#include "base/log.h"

namespace lfd {
namespace {

constexpr int kCoarsest = 4, kFinest = 9;
constexpr double kMargin = 0.05;  // of the screen's size, on every side
constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();

// Solves a symmetric positive definite system by Cholesky's method; false where it is not (numerically) one.
bool solve(std::array<std::array<double, 8>, 8>& a, std::array<double, 8>& b) {
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = a[i][j];
      for (std::size_t k = 0; k < j; ++k) sum -= a[i][k] * a[j][k];
      if (i == j && !(sum > 1e-12)) return false;
      a[i][j] = i == j ? std::sqrt(sum) : sum / a[j][j];
    }
  }
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= a[i][k] * b[k];
    b[i] /= a[i][i];
  }
  for (std::size_t i = 8; i-- > 0;) {
    for (std::size_t k = i + 1; k < 8; ++k) b[i] -= a[k][i] * b[k];
    b[i] /= a[i][i];
  }
  return true;
}

// The homography nearest to the grid's nodes in the least squares of its linear equations (Hartley & Zisserman, 2nd
// edition, 4.1), in coordinates of about unit size. Any base will do, so a poor one only costs table resolution.
glm::dmat3 fitted_homography(const DisplayCalibration& display, const GridNodes& nodes) {
  const glm::dvec2 screen_unit = 0.5 * glm::dvec2(display.screen.width_m, display.screen.height_m);
  const glm::dvec2 image_unit = 0.5 * glm::dvec2(display.image.width, display.image.height);
  std::array<std::array<double, 8>, 8> a{};
  std::array<double, 8> b{};
  double count = 0;
  const auto add = [&](const std::array<double, 8>& row, double value) {
    for (std::size_t i = 0; i < 8; ++i) {
      b[i] += row[i] * value;
      for (std::size_t j = 0; j < 8; ++j) a[i][j] += row[i] * row[j];
    }
  };
  for (int row = 0; row < nodes.rows; ++row) {
    for (int column = 0; column < nodes.columns; ++column) {
      const ScreenPoint& node = nodes.at(column, row);
      if (std::isnan(node.x)) continue;
      const PixelPoint place = nodes.place(column, row);
      const glm::dvec2 s = glm::dvec2(node.x, node.y) / screen_unit;
      const glm::dvec2 p = glm::dvec2(place.x, place.y) / image_unit - 1.0;
      add({s.x, s.y, 1, 0, 0, 0, -p.x * s.x, -p.x * s.y}, p.x);
      add({0, 0, 0, s.x, s.y, 1, -p.y * s.x, -p.y * s.y}, p.y);
      ++count;
    }
  }
  for (auto& line : a) {
    for (double& value : line) value /= count;
  }
  for (double& value : b) value /= count;
  const glm::dmat3 pixels_from_unit(image_unit.x, 0, 0, 0, image_unit.y, 0, image_unit.x, image_unit.y, 1);
  const glm::dmat3 unit_from_screen(1 / screen_unit.x, 0, 0, 0, 1 / screen_unit.y, 0, 0, 0, 1);
  glm::dmat3 h(1, 0, 0, 0, -1, 0, 0, 0, 1);  // the ideal map
  if (solve(a, b)) h = glm::dmat3(b[0], b[3], b[6], b[1], b[4], b[7], b[2], b[5], 1);
  // The horizon must not cross the screen, or the base would be of no use.
  for (const double x : {-1.2, 1.2}) {
    for (const double y : {-1.2, 1.2}) {
      if (!(h[0].z * x + h[1].z * y + 1 > 0.1)) h = glm::dmat3(1, 0, 0, 0, -1, 0, 0, 0, 1);
    }
  }
  return pixels_from_unit * h * unit_from_screen;
}

// The node's residual continued from two neighbours in a row where they are there; NaN where none is.
glm::dvec2 continued(const std::vector<glm::dvec2>& known, int columns, int rows, int column, int row) {
  glm::dvec2 sum(0.0);
  double weight = 0;
  const auto at = [&](int i, int j) {
    if (i < 0 || j < 0 || i >= columns || j >= rows) return glm::dvec2(kNowhere);
    return known[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(i)];
  };
  for (const auto& [i, j] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}}) {
    const glm::dvec2 next = at(column + i, row + j), beyond = at(column + 2 * i, row + 2 * j);
    if (std::isnan(next.x)) continue;
    // A straight line counts far more than a lone neighbour.
    const double share = std::isnan(beyond.x) ? 1e-3 : 1;
    sum += share * (std::isnan(beyond.x) ? next : 2.0 * next - beyond);
    weight += share;
  }
  return weight > 0 ? sum / weight : glm::dvec2(kNowhere);
}

// Ring by ring outward from what is known.
void fill_unknown(std::vector<glm::dvec2>& residual, int columns, int rows) {
  for (int ring = 0;; ++ring) {
    std::vector<glm::dvec2> next = residual;
    bool any_left = false, any_found = false;
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const auto i =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
        if (!std::isnan(residual[i].x)) continue;
        next[i] = continued(residual, columns, rows, column, row);
        (std::isnan(next[i].x) ? any_left : any_found) = true;
      }
    }
    residual = std::move(next);
    if (!any_left) return;
    LFD_CHECK(any_found, "a grid lights some of the screen");
  }
}

}  // namespace

std::optional<glm::dvec2> WarpTable::at(glm::dvec2 s) const {
  const glm::dvec3 q = image_from_screen * glm::dvec3(s, 1);
  if (!(q.z > 0)) return std::nullopt;
  const glm::dvec2 place = glm::clamp((s - low) / cell, glm::dvec2(0.0), glm::dvec2(columns - 1, rows - 1));
  const int column = std::min(static_cast<int>(place.x), columns - 2),
            row = std::min(static_cast<int>(place.y), rows - 2);
  const auto node = [&](int i, int j) {
    return glm::dvec2(residual_px[static_cast<std::size_t>(row + j) * static_cast<std::size_t>(columns) +
                                  static_cast<std::size_t>(column + i)]);
  };
  const glm::dvec2 share = place - glm::dvec2(column, row);
  const glm::dvec2 lower = glm::mix(node(0, 0), node(1, 0), share.x), upper = glm::mix(node(0, 1), node(1, 1), share.x);
  return glm::dvec2(q) / q.z + glm::mix(lower, upper, share.y);
}

WarpTable warp_table(const DisplayCalibration& display, const ModuleCalibration& module, int level) {
  const auto& grid = std::get<GridMap>(module.map);
  WarpTable table;
  table.image_from_screen = fitted_homography(display, grid.nodes());
  table.columns = (1 << level) + 1;
  table.rows = std::max(
      5, static_cast<int>(std::ceil((table.columns - 1) * display.screen.height_m / display.screen.width_m)) + 1);
  const glm::dvec2 size = (1 + 2 * kMargin) * glm::dvec2(display.screen.width_m, display.screen.height_m);
  table.low = -0.5 * size;
  table.cell = size / glm::dvec2(table.columns - 1, table.rows - 1);

  const auto exact = [&](glm::dvec2 s) {
    const auto p = image_from_screen(grid, ScreenPoint{s.x, s.y});
    return p ? glm::dvec2(p->x, p->y) : glm::dvec2(kNowhere);
  };
  std::vector<glm::dvec2> residual;
  std::vector<bool> is_measured;
  for (int row = 0; row < table.rows; ++row) {
    for (int column = 0; column < table.columns; ++column) {
      const glm::dvec2 s = table.low + glm::dvec2(column, row) * table.cell;
      const glm::dvec3 q = table.image_from_screen * glm::dvec3(s, 1);
      residual.push_back(exact(s) - glm::dvec2(q) / q.z);
      is_measured.push_back(!std::isnan(residual.back().x));
    }
  }
  if (std::ranges::find(is_measured, true) == is_measured.end()) residual.assign(residual.size(), glm::dvec2(0.0));
  fill_unknown(residual, table.columns, table.rows);
  table.residual_px.assign(residual.begin(), residual.end());

  // Bilinear interpolation errs most in the middles of cells and of their sides.
  const auto measured = [&](int column, int row) {
    return is_measured[static_cast<std::size_t>(row) * static_cast<std::size_t>(table.columns) +
                       static_cast<std::size_t>(column)];
  };
  for (int row = 0; row + 1 < table.rows; ++row) {
    for (int column = 0; column + 1 < table.columns; ++column) {
      const bool is_inside = measured(column, row) && measured(column + 1, row) && measured(column, row + 1) &&
                             measured(column + 1, row + 1);
      double& worst = is_inside ? table.error_px : table.border_error_px;
      for (const glm::dvec2& share : {glm::dvec2(0.5, 0.5), glm::dvec2(0.5, 0), glm::dvec2(0, 0.5)}) {
        const glm::dvec2 s = table.low + (glm::dvec2(column, row) + share) * table.cell;
        const double error = glm::length(table.at(s).value_or(glm::dvec2(kNowhere)) - exact(s));
        if (error > worst) worst = error;  // not where there is no pixel: NaN compares false
      }
    }
  }
  return table;
}

WarpTables warp_tables(const DisplayCalibration& display, const std::vector<std::uint32_t>& modules, int level) {
  WarpTables tables;
  for (tables.level = level != 0 ? level : kCoarsest;; ++tables.level) {
    tables.of_module.clear();
    bool are_true = true;
    for (const std::uint32_t k : modules) {
      const ModuleCalibration& module = display.modules[k];
      if (!std::holds_alternative<GridMap>(module.map)) {
        tables.of_module.emplace_back();
        continue;
      }
      tables.of_module.emplace_back(warp_table(display, module, tables.level));
      const double error_px = tables.of_module.back()->error_px;
      are_true = are_true && error_px <= kTableTolerance_px;
      if (level == 0 && tables.level == kFinest && error_px > kMostTableError_px) {
        tables.of_module.resize(modules.size());  // it will be refused: the others need no table
        return tables;
      }
      if (level == 0 && !are_true && tables.level < kFinest) break;  // a finer one is needed anyway
    }
    if (level != 0 || are_true || tables.level == kFinest) return tables;
  }
}

Result<std::vector<std::string>> warnings_of(const WarpTables& tables, const std::vector<std::uint32_t>& modules) {
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < modules.size(); ++i) {
    if (!tables.of_module[i]) continue;
    if (const double border_px = tables.of_module[i]->border_error_px; border_px > kMostTableError_px) {
      warnings.push_back(fmt::format("module {}: at the border of what was measured its table is up to {:.2g} px off",
                                     modules[i], border_px));
    }
    if (tables.of_module[i]->error_px <= kTableTolerance_px) continue;
    const std::string off = fmt::format("module {}: a table of {} columns is up to {:.2g} px off its measured map",
                                        modules[i], tables.columns(), tables.of_module[i]->error_px);
    if (tables.of_module[i]->error_px > kMostTableError_px)
      return Error(fmt::format("{}; at most {} px is possible: the grid bends too sharply", off, kMostTableError_px));
    warnings.push_back(fmt::format("{}; {} px is aimed at", off, kTableTolerance_px));
  }
  return warnings;
}

}  // namespace lfd
