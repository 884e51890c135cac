// Measured grids with folds, holes and nonsense: refused by name, or an inverse that is true wherever it answers.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/log.h"
#include "bench/stability/bent_grids.h"
#include "bench/stability/groups.h"
#include "calibration/maps/grid.h"

namespace lfd::bench {
namespace {

constexpr const char* kGroup = "grid";
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// 256 x 192 pixels.
GridNodes bent_nodes() { return bench::bent_nodes({256, 192}); }

// Screen -> image -> screen over the screen and beside it, in metres; image -> screen -> image likewise, in pixels of
// 1.6 mm, which a fold may answer with another pixel of the same screen point: it is judged on the screen.
void inverse(Worst& worst, const GridMap& map, double least_share) {
  std::size_t pixels = 0, answers = 0;
  for (double s = -0.25; s <= 0.25; s += 0.0073) {
    for (double y = -0.19; y <= 0.19; y += 0.0059) {
      const auto p = image_from_screen(map, {s, y});
      if (!p) continue;
      const auto back = screen_from_image(map, *p);
      worst.take(back ? std::hypot(back->x - s, back->y - y) : kInfinity);
    }
  }
  for (double u = 0.5; u < 256; u += 3.7) {
    for (double v = 0.5; v < 192; v += 3.1) {
      const auto s = screen_from_image(map, {u, v});
      ++pixels;
      if (!s) continue;
      ++answers;
      const auto p = image_from_screen(map, *s);
      const auto again = p ? screen_from_image(map, *p) : std::nullopt;
      worst.take(again ? std::hypot(again->x - s->x, again->y - s->y) : kInfinity);
    }
  }
  if (static_cast<double>(answers) < least_share * static_cast<double>(pixels)) worst.take(kInfinity);
}

// least_share: of the pixels that have a screen point.
StabilityCase inverts(const char* name, GridNodes nodes, double least_share) {
  double farthest_m = 0;
  for (const ScreenPoint& n : nodes.node) {
    if (!std::isnan(n.x)) farthest_m = std::max({farthest_m, std::abs(n.x), std::abs(n.y)});
  }
  const double bound = 64 * std::numeric_limits<double>::epsilon() * farthest_m;
  const std::string reason = fmt::format(
      "m on the screen there and back: 64 roundings of the farthest node; {} of the pixels have a screen point",
      least_share);
  return bounded(
      kGroup, name, bound, reason,
      [nodes, least_share](Worst& worst) {
        const auto map = GridMap::make(nodes);
        if (!map) return worst.take(kInfinity);
        inverse(worst, *map, least_share);
      },
      1000);
}

StabilityCase rejects(const std::string& name, const std::string& words, GridNodes nodes) {
  return refused(kGroup, name, words, [nodes]() -> Status {
    const auto map = GridMap::make(nodes);
    if (!map) return map.error();
    return {};
  });
}

GridNodes with_holes() {
  GridNodes nodes = with_holes_at_border(bent_nodes());
  node(nodes, 0, nodes.rows - 1) = {kNaN, kNaN};
  return nodes;
}

GridNodes with_node(ScreenPoint value) { return bench::with_node(bent_nodes(), value); }

void add_refusals(StabilityCases& cases) {
  GridNodes nodes = bent_nodes();
  nodes.rows = 1;
  nodes.node.resize(17);
  cases.push_back(rejects("a single row", "rows: 1; 2 to 4096", nodes));
  nodes = bent_nodes();
  nodes.columns = 1;
  nodes.node.resize(13);
  cases.push_back(rejects("a single column", "columns: 1; 2 to 4096", nodes));
  nodes = bent_nodes();
  node(nodes, 9, 6) = node(nodes, 8, 6);
  cases.push_back(rejects("duplicated nodes", "column 8, row 6: at the same place", nodes));
  nodes = bent_nodes();
  node(nodes, 8, 7) = node(nodes, 8, 6);
  cases.push_back(rejects("duplicated nodes, one above the other", "column 8, row 6: at the same place", nodes));
  for (const double value : {1e30, -1e30, 1e300, kInfinity, -kInfinity}) {
    cases.push_back(rejects(fmt::format("a node at {:g} m", value), "column 8, row 6", with_node({value, 0})));
  }
  cases.push_back(rejects("half a hole", "s 110: column 8, row 6: is missing", with_node({kNaN, 0})));
  nodes = bent_nodes();
  for (auto& n : nodes.node) n = {kNaN, kNaN};
  cases.push_back(rejects("holes alone", "no cell of the grid has all four corners", nodes));
  nodes = bent_nodes();
  nodes.node.pop_back();
  cases.push_back(rejects("a node too few", "220 nodes; columns x rows are 221", nodes));
  for (const double step : {0.0, -1.0, kNaN, kInfinity}) {
    nodes = bent_nodes();
    nodes.step_v_px = step;
    cases.push_back(rejects(fmt::format("a step of {} px", step), "step_v_px", nodes));
  }
  nodes = bent_nodes();
  nodes.columns = std::numeric_limits<int>::max();
  cases.push_back(rejects("2^31 - 1 columns", "columns: 2147483647", nodes));
}

}  // namespace

void add_grid_cases(StabilityCases& cases) {
  // Every pixel, but those whose cell has a hole at a corner, or that lies in what has folded.
  cases.push_back(inverts("bent smoothly", bent_nodes(), 1));
  cases.push_back(inverts("folded twice", folded(bent_nodes()), 0.35));
  cases.push_back(inverts("holes along two borders and at a corner", with_holes(), 0.84));
  cases.push_back(inverts("a hole in the middle", with_node({kNaN, kNaN}), 0.97));
  cases.push_back(inverts("one node thrown far across its neighbours", with_node({0.19, -0.14}), 0.9));
  cases.push_back(inverts("one node at 9999 m", with_node({9999, 0}), 0.9));
  cases.push_back(inverts("mirrored as a whole", mirrored(bent_nodes()), 1));
  GridNodes nodes = bent_nodes();
  for (auto& n : nodes.node) n = {1e-9 * n.x, 1e-9 * n.y};
  cases.push_back(inverts("shrunk to a nanometre", nodes, 1));
  nodes = bent_nodes();
  node(nodes, 9, 6) = {std::nextafter(node(nodes, 8, 6).x, 1), node(nodes, 8, 6).y};
  cases.push_back(inverts("two nodes one rounding apart", nodes, 0.9));
  cases.push_back(faultless(kGroup, "folded twice: share of mirrored cells", "0.35 to 0.65 of the cells", [] {
    const auto map = GridMap::make(folded(bent_nodes()));
    if (!map) return map.error().message();
    const double share = map->folded_share();
    return share > 0.35 && share < 0.65 ? std::string() : fmt::format("{}", share);
  }));
  add_refusals(cases);
}

}  // namespace lfd::bench
