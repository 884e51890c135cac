// Error over time as an SVG picture.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/log.h"
#include "bench/ao/ao_bench.h"
#include "cli/plots/svg.h"

namespace lfd::bench {
namespace {

constexpr double kWidth = 980, kHeight = 620, kLeft = 80, kRight = 190, kTop = 50, kBottom = 60;
constexpr const char* kGrid = "#dddddd";
constexpr const char* kColors[] = {"#1f77b4", "#ff7f0e", "#2ca02c", "#d62728", "#9467bd", "#8c564b", "#e377c2",
                                   "#444444", "#bcbd22", "#17a2b8", "#000080", "#008000", "#800000"};

// A logarithmic axis.
struct Axis {
  double low, high;  // decades
  double from_px, to_px;
  double at(double value) const { return from_px + (std::log10(value) - low) / (high - low) * (to_px - from_px); }
};

struct Dot {
  double ms, mae;
  std::string method, name;
  bool is_shared;
};

std::vector<Dot> dots_of(const AoTable& table, const std::string& scene, double share) {
  std::vector<Dot> dots;
  for (const AoRow& row : table.rows) {
    if (row.scene != scene || !row.is_middle() || row.radius_share != share || row.rung.is_default) continue;
    if (!(row.total_ms() > 0) || !(fitted_or_not(row).mae > 0)) continue;
    dots.push_back({row.total_ms(), fitted_or_not(row).mae, row.rung.method(), row.rung.name,
                    row.rung.settings.shared().neighbours() > 0});
  }
  std::ranges::sort(dots, {}, &Dot::ms);
  return dots;
}

// Places at 1, 2 and 5 times powers of ten.
std::vector<double> ticks_of(const Axis& axis) {
  std::vector<double> ticks;
  for (int decade = static_cast<int>(std::floor(axis.low)); decade <= axis.high; ++decade) {
    for (const double step : {1.0, 2.0, 5.0}) {
      const double value = step * std::pow(10, decade);
      if (std::log10(value) >= axis.low && std::log10(value) <= axis.high) ticks.push_back(value);
    }
  }
  return ticks;
}

void draw_grid(plots::Svg& svg, const Axis& x, const Axis& y) {
  for (const double value : ticks_of(x)) {
    svg.line({x.at(value), y.from_px}, {x.at(value), y.to_px}, {.stroke = kGrid});
    svg.text({x.at(value), y.from_px + 18}, fmt::format("{:g}", value), {.anchor = plots::Anchor::kMiddle});
  }
  for (const double value : ticks_of(y)) {
    svg.line({x.from_px, y.at(value)}, {x.to_px, y.at(value)}, {.stroke = kGrid});
    svg.text({x.from_px - 6, y.at(value) + 4}, fmt::format("{:g}", value), {.anchor = plots::Anchor::kEnd});
  }
}

// From its first dot to the right end, down where a dot is better than all before.
void draw_front(plots::Svg& svg, const std::vector<Dot>& dots, const Axis& x, const Axis& y) {
  std::vector<plots::Place> steps;
  double best = 0;
  for (const Dot& dot : dots) {
    if (!steps.empty() && dot.mae >= best) continue;
    if (!steps.empty()) steps.push_back({x.at(dot.ms), y.at(best)});
    best = dot.mae;
    steps.push_back({x.at(dot.ms), y.at(dot.mae)});
  }
  if (steps.empty()) return;
  steps.push_back({x.to_px, y.at(best)});
  svg.polyline(steps, {.stroke = "#cc0000", .width_px = 1.5});
}

void draw_dots(plots::Svg& svg, const std::vector<Dot>& dots, const std::vector<std::string>& methods, const Axis& x,
               const Axis& y) {
  for (const Dot& dot : dots) {
    const auto number = static_cast<std::size_t>(std::ranges::find(methods, dot.method) - methods.begin());
    const char* color = kColors[number % std::size(kColors)];
    const plots::Place at{x.at(dot.ms), y.at(dot.mae)};
    if (dot.is_shared) {
      svg.rectangle({at.x - 5, at.y - 5, 10, 10}, {.stroke = color, .fill = "#ffffff", .width_px = 2});
    } else {
      svg.circle(at, 5, {.fill = color});
    }
  }
}

void draw_legend(plots::Svg& svg, const std::vector<std::string>& methods, double left_px) {
  double line = kTop + 8;
  for (std::size_t i = 0; i < methods.size(); ++i, line += 19) {
    svg.circle({left_px, line - 4}, 5, {.fill = kColors[i % std::size(kColors)]});
    svg.text({left_px + 12, line}, methods[i], {});
  }
  svg.rectangle({left_px - 5, line - 9, 10, 10}, {.stroke = "#444444", .width_px = 2});
  svg.text({left_px + 12, line}, "shared by neighbours", {});
  svg.line({left_px - 6, line + 15}, {left_px + 6, line + 15}, {.stroke = "#cc0000", .width_px = 1.5});
  svg.text({left_px + 12, line + 19}, "Pareto front", {});
}

}  // namespace

std::string svg_of(const AoTable& table, const std::string& scene) {
  const double share = table.middle_radius();
  const std::vector<Dot> dots = dots_of(table, scene, share);
  plots::Svg svg(kWidth, kHeight);
  if (dots.empty()) return svg.finish();
  std::vector<std::string> methods;
  double worst = 0, best = 1;
  for (const Dot& dot : dots) {
    worst = std::max(worst, dot.mae);
    best = std::min(best, dot.mae);
    if (std::ranges::find(methods, dot.method) == methods.end()) methods.push_back(dot.method);
  }
  std::ranges::sort(methods);
  const Axis x{std::log10(dots.front().ms) - 0.08, std::log10(dots.back().ms) + 0.08, kLeft, kWidth - kRight};
  const Axis y{std::log10(best) - 0.05, std::log10(worst) + 0.05, kHeight - kBottom, kTop};
  draw_grid(svg, x, y);
  svg.text({kLeft, 24},
           fmt::format("Ambient occlusion: error over time, {}, radius {:g} % of the ROI diagonal", scene, 100 * share),
           {.size_px = 15, .is_bold = true});
  svg.text({0.5 * (x.from_px + x.to_px), kHeight - 18}, "GPU time of occlusion and blur, ms of one module",
           {.anchor = plots::Anchor::kMiddle});
  svg.text({kLeft, 40},
           fmt::format("{}, {}x{} px, {}, lfd {}", table.rows.front().display, table.rows.front().image.width,
                       table.rows.front().image.height, table.renderer, table.version),
           {.size_px = 10, .colour = "#666666"});
  svg.text({22, 0.5 * (y.from_px + y.to_px)},
           table.scenes().size() > 1 ? "mean absolute error, curve fitted on the other scenes" : "mean absolute error",
           {.anchor = plots::Anchor::kMiddle, .is_upright = true});
  draw_front(svg, dots, x, y);
  draw_dots(svg, dots, methods, x, y);
  draw_legend(svg, methods, x.to_px + 20);
  return svg.finish();
}

}  // namespace lfd::bench
