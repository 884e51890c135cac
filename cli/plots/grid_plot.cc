// A measured grid as it lies on the screen.
#include <algorithm>
#include <cmath>

#include "base/log.h"
#include "cli/plots/check_plots.h"
#include "cli/plots/heat_map.h"

namespace lfd::plots {
namespace {

constexpr int kMostLines = 48;    // of nodes, in each direction
constexpr int kMostMarks = 4000;  // folded cells and borders of holes
constexpr const char* kFoldInk = "#d62728";
constexpr const char* kHoleInk = "#e08214";

bool is_hole(const GridNodes& nodes, int column, int row) { return !is_finite(nodes.at(column, row)); }

Place placed(const Axes& axes, const ScreenPoint& s) { return axes.at(s.x, s.y); }

// The bounds of the nodes and of the screen.
std::pair<Range, Range> ranges_of(const DisplayCalibration& display, const GridNodes& nodes) {
  Range s{-display.screen.width_m / 2, display.screen.width_m / 2},
      y{-display.screen.height_m / 2, display.screen.height_m / 2};
  for (const ScreenPoint& node : nodes.node) {
    if (!is_finite(node)) continue;
    s = {std::min(s.from, node.x), std::max(s.to, node.x)};
    y = {std::min(y.from, node.y), std::max(y.to, node.y)};
  }
  const double margin_s = 0.03 * (s.to - s.from), margin_y = 0.03 * (y.to - y.from);
  return {{s.from - margin_s, s.to + margin_s}, {y.from - margin_y, y.to + margin_y}};
}

// A line of nodes, broken at holes.
template <class NodeAt>
void draw_line(Svg& svg, const Axes& axes, int count, NodeAt node_at) {
  std::vector<Place> run;
  const Pen pen{.stroke = "#5f88c4", .width_px = 0.8};
  for (int i = 0; i < count; ++i) {
    const ScreenPoint& node = node_at(i);
    if (is_finite(node)) {
      run.push_back(placed(axes, node));
      continue;
    }
    if (run.size() > 1) svg.polyline(run, pen);
    run.clear();
  }
  if (run.size() > 1) svg.polyline(run, pen);
}

void draw_mesh(Svg& svg, const Axes& axes, const GridNodes& nodes) {
  const auto every = [](int count) { return std::max(1, (count - 1) / kMostLines); };
  for (int row = 0; row < nodes.rows; row += every(nodes.rows)) {
    draw_line(svg, axes, nodes.columns, [&](int i) -> const ScreenPoint& { return nodes.at(i, row); });
  }
  for (int column = 0; column < nodes.columns; column += every(nodes.columns)) {
    draw_line(svg, axes, nodes.rows, [&](int i) -> const ScreenPoint& { return nodes.at(column, i); });
  }
}

// Folded cells are filled, nodes beside a hole marked; answers how many were drawn.
int draw_faults(Svg& svg, const Axes& axes, const GridMap& map) {
  const GridNodes& nodes = map.nodes();
  int marks = 0;
  for (int row = 0; row + 1 < nodes.rows; ++row) {
    for (int column = 0; column + 1 < nodes.columns && marks < kMostMarks; ++column) {
      std::vector<Place> corners;
      for (const auto& [i, j] : {std::pair{column, row}, std::pair{column + 1, row}, std::pair{column + 1, row + 1},
                                 std::pair{column, row + 1}}) {
        if (!is_hole(nodes, i, j)) corners.push_back(placed(axes, nodes.at(i, j)));
      }
      if (corners.size() < 4) {
        for (const Place p : corners) svg.circle(p, 2.2, {.fill = kHoleInk});
        ++marks;
      } else if (map.has_folded(column, row)) {
        svg.polygon(corners, {.stroke = kFoldInk, .fill = kFoldInk});
        ++marks;
      }
    }
  }
  return marks;
}

}  // namespace

std::string grid(const DisplayCalibration& display, int module) {
  const auto& map = std::get<GridMap>(display.modules[static_cast<std::size_t>(module)].map);
  const GridNodes& nodes = map.nodes();
  const auto [s, y] = ranges_of(display, nodes);
  const Axes axes(with_equal_scales({90, 60, 680, 620}, s, y), s, y);
  Svg svg(1000, axes.bottom_px() + 90);
  draw_mesh(svg, axes, nodes);
  const int marks = draw_faults(svg, axes, map);
  const double half_s = display.screen.width_m / 2, half_y = display.screen.height_m / 2;
  svg.polygon({axes.at(-half_s, -half_y), axes.at(half_s, -half_y), axes.at(half_s, half_y), axes.at(-half_s, half_y)},
              {.stroke = "#222222", .width_px = 2});
  axes.draw(svg, {fmt::format("{}, module {}: {} x {} measured nodes on the screen", display.name, module,
                              nodes.columns, nodes.rows),
                  "s, m", "y, m"});
  draw_key(svg, {800, 70}, "#5f88c4", "lines of nodes");
  draw_key(svg, {800, 94}, "#222222", "border of the screen");
  draw_key(svg, {800, 118}, kHoleInk, "nodes beside a hole");
  draw_key(svg, {800, 142}, kFoldInk, "folded cells");
  svg.text({430, axes.bottom_px() + 66},
           fmt::format("{:.2f} % of the cells lack a corner, {:.2f} % of the others have folded.{}",
                       100 * (1 - map.complete_share()), 100 * map.folded_share(),
                       marks < kMostMarks ? "" : " Only the first of them are marked."),
           {.anchor = Anchor::kMiddle});
  return svg.finish();
}

}  // namespace lfd::plots
