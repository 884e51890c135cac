// Nodes by solving the pinhole backward; their distance by halving.
#include "calibration/fit/residual_grid.h"

#include <ceres/jet.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace lfd {
namespace {

constexpr int kMostIntervals = 256;

std::optional<PixelPoint> project(const FittedPinhole& fitted, ScreenPoint s) {
  double uv[2];
  if (!fitted.family.project(fitted.z.data(), fitted.curvature, s.x, s.y, uv)) return std::nullopt;
  return PixelPoint{uv[0], uv[1]};
}

// A Newton step from `s` toward the point seen at p. Absent behind the pinhole and where the map is singular.
std::optional<glm::dvec2> newton_step(const FittedPinhole& fitted, ScreenPoint s, PixelPoint p) {
  using Jet = ceres::Jet<double, 2>;
  std::array<Jet, kPinholeParameters> z;
  std::ranges::transform(fitted.z, z.begin(), [](double number) { return Jet(number); });
  Jet uv[2];
  if (!fitted.family.project(z.data(), Jet(fitted.curvature), Jet(s.x, 0), Jet(s.y, 1), uv)) return std::nullopt;
  const glm::dmat2 jacobian({uv[0].v[0], uv[1].v[0]}, {uv[0].v[1], uv[1].v[1]});
  const glm::dvec2 step = glm::inverse(jacobian) * glm::dvec2(p.x - uv[0].a, p.y - uv[1].a);
  if (!std::isfinite(step.x) || !std::isfinite(step.y)) return std::nullopt;
  return step;
}

GridNodes nodes_of(const FittedPinhole& fitted, const ResidualField& field, ImageSize image, int nu, int nv) {
  GridNodes nodes;
  nodes.columns = nu + 3;
  nodes.rows = nv + 3;
  nodes.step_u_px = static_cast<double>(image.width) / nu;
  nodes.step_v_px = static_cast<double>(image.height) / nv;
  nodes.first_u_px = -nodes.step_u_px;
  nodes.first_v_px = -nodes.step_v_px;
  constexpr double kHole = std::numeric_limits<double>::quiet_NaN();
  for (int row = 0; row < nodes.rows; ++row) {
    for (int column = 0; column < nodes.columns; ++column) {
      const PixelPoint p = nodes.place(column, row);
      const glm::dvec2 d = field.at(p);
      const auto s = screen_from_image(fitted, {p.x + d.x, p.y + d.y});
      nodes.node.push_back(s.value_or(ScreenPoint{kHole, kHole}));
    }
  }
  return nodes;
}

// The largest distance in px, over the middles of the cells in the image, between what the grid and the field say.
double worst_middle_px(const FittedPinhole& fitted, const ResidualField& field, const GridMap& grid) {
  double worst = 0;
  const GridNodes& nodes = grid.nodes();
  for (int row = 1; row + 2 < nodes.rows; ++row) {
    for (int column = 1; column + 2 < nodes.columns; ++column) {
      const PixelPoint node = nodes.place(column, row);
      const PixelPoint p{node.x + 0.5 * nodes.step_u_px, node.y + 0.5 * nodes.step_v_px};
      const auto s = screen_from_image(grid, p);
      if (!s) continue;
      const auto seen = project(fitted, *s);
      if (!seen) continue;
      const glm::dvec2 d = field.at(p);
      worst = std::max(worst, std::hypot(seen->x - p.x - d.x, seen->y - p.y - d.y));
    }
  }
  return worst;
}

}  // namespace

std::optional<ScreenPoint> screen_from_image(const FittedPinhole& fitted, PixelPoint p) {
  // The plane through the screen's middle is where the search begins; for a planar screen, and where it ends.
  auto s = screen_from_image(fitted.family.at(fitted.z), p);
  if (!s || fitted.curvature == 0) return s;
  for (int iteration = 0; iteration < 50; ++iteration) {
    const auto step = newton_step(fitted, *s, p);
    if (!step) return std::nullopt;
    *s = {s->x + step->x, s->y + step->y};
    if (glm::length(*step) <= 1e-14 * (1 + std::hypot(s->x, s->y))) return s;
  }
  return std::nullopt;
}

std::optional<GridMap> residual_grid(const FittedPinhole& fitted, const ResidualField& field, ImageSize image,
                                     double tolerance_px) {
  int nu = field.columns - 5, nv = field.rows - 5;  // the field's own intervals within the image
  while (true) {
    auto grid = GridMap::make(nodes_of(fitted, field, image, nu, nv));
    if (!grid || grid->folded_share() > 0) return std::nullopt;
    const bool is_last = 2 * std::max(nu, nv) > kMostIntervals;
    if (is_last || worst_middle_px(fitted, field, *grid) <= tolerance_px) return *std::move(grid);
    nu *= 2;
    nv *= 2;
  }
}

}  // namespace lfd
