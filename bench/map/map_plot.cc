// Error over time as an SVG picture.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/log.h"
#include "bench/map/map_bench.h"
#include "cli/plots/svg.h"

namespace lfd::bench {
namespace {

constexpr double kWidth = 900, kHeight = 560, kLeft = 80, kRight = 330, kTop = 50, kBottom = 60;
constexpr const char* kColors[] = {"#444444", "#1f77b4", "#17a2b8", "#2ca02c", "#9467bd", "#e377c2",
                                   "#ff7f0e", "#d62728", "#8c564b", "#bcbd22", "#7f7f7f", "#000080",
                                   "#008000", "#800000", "#ff00aa", "#00aaff"};

// A logarithmic axis over whole decades or halves of them.
struct Axis {
  double low, high;  // decades
  double from_px, to_px;
  double at(double value) const {
    return from_px + (std::log10(std::clamp(value, std::pow(10, low), std::pow(10, high))) - low) / (high - low) *
                         (to_px - from_px);
  }
};

constexpr const char* kGrid = "#dddddd";
constexpr const char* kBound = "#cc0000";

void draw_grid(plots::Svg& svg, const Axis& x, const Axis& y) {
  for (double decade = std::ceil(y.low); decade <= y.high; ++decade) {
    const double at = y.at(std::pow(10, decade));
    svg.line({x.from_px, at}, {x.to_px, at}, {.stroke = kGrid});
    svg.text({x.from_px - 6, at + 4}, fmt::format("1e{}", static_cast<int>(decade)), {.anchor = plots::Anchor::kEnd});
  }
  for (const double value : {0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0, 20.0, 50.0}) {
    if (std::log10(value) < x.low || std::log10(value) > x.high) continue;
    const double at = x.at(value);
    svg.line({at, y.from_px}, {at, y.to_px}, {.stroke = kGrid});
    svg.text({at, y.from_px + 18}, fmt::format("{}", value), {.anchor = plots::Anchor::kMiddle});
  }
}

void draw_labels(plots::Svg& svg, const std::string& title, const std::string& time, const Axis& x, const Axis& y) {
  svg.text({kLeft, 24}, title, {.size_px = 15, .is_bold = true});
  svg.text({0.5 * (x.from_px + x.to_px), kHeight - 18}, time + " over that of plain vertices",
           {.anchor = plots::Anchor::kMiddle});
  svg.text({22, 0.5 * (y.from_px + y.to_px)}, "99.9 % position error / ROI diagonal",
           {.anchor = plots::Anchor::kMiddle, .is_upright = true});
}

void draw_bounds(plots::Svg& svg, const Axis& x, const Axis& y) {
  const plots::Pen pen{.stroke = kBound, .dashes = "6 4"};
  const double error = y.at(MapBounds().percent_999), twice = x.at(MapBounds().ratio);
  svg.line({x.from_px, error}, {x.to_px, error}, pen);
  svg.line({twice, y.from_px}, {twice, y.to_px}, pen);
}

// Errors below this are drawn here: a logarithm has no 0.
double drawn_error(const MapRow& row) { return std::max(row.truth.percent_999, 1e-9); }

}  // namespace

std::string svg_of(const MapTable& table, const std::string& scene) {
  std::vector<MapRow> rows;
  std::ranges::copy_if(table.rows, std::back_inserter(rows), [&](const MapRow& row) { return row.scene == scene; });
  double least = 1, most = 2, best = 1e-7, worst = 1e-3;
  std::vector<std::string> names;
  for (const MapRow& row : rows) {
    least = std::min(least, cost_ratio(table, row).median);
    most = std::max(most, cost_ratio(table, row).median);
    best = std::min(best, drawn_error(row));
    worst = std::max(worst, row.truth.percent_999);
    if (std::ranges::find(names, row.variant) == names.end()) names.push_back(row.variant);
  }
  const Axis x{std::log10(least) - 0.1, std::log10(most) + 0.1, kLeft, kWidth - kRight};
  const Axis y{std::floor(std::log10(best)), std::ceil(std::log10(worst)), kHeight - kBottom, kTop};
  plots::Svg svg(kWidth, kHeight);
  draw_grid(svg, x, y);
  draw_labels(svg, fmt::format("Position error over time: {} on {}", scene, table.display),
              table.is_software ? "wall-clock time" : "GPU time", x, y);
  draw_bounds(svg, x, y);
  const std::uint32_t first_module = rows.empty() ? 0 : rows.front().module;
  for (const MapRow& row : rows) {
    const auto number = static_cast<std::size_t>(std::ranges::find(names, row.variant) - names.begin());
    const char* color = kColors[number % std::size(kColors)];
    const plots::Place at{x.at(cost_ratio(table, row).median), y.at(drawn_error(row))};
    if (row.module == first_module) {
      svg.circle(at, 6, {.fill = color});
    } else {
      svg.rectangle({at.x - 5, at.y - 5, 10, 10}, {.stroke = color, .width_px = 2});
    }
  }
  double line = kTop + 8;
  for (std::size_t i = 0; i < names.size(); ++i, line += 19) {
    svg.circle({x.to_px + 18, line - 4}, 5, {.fill = kColors[i % std::size(kColors)]});
    svg.text({x.to_px + 30, line}, names[i], {});
  }
  svg.text({x.to_px + 12, line + 12}, fmt::format("disc: module {}; square: the others; red: bounds", first_module),
           {.colour = "#666666"});
  return svg.finish();
}

}  // namespace lfd::bench
