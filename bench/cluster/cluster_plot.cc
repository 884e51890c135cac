// Latency and the controller's cost over the number of nodes, as an SVG picture.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/log.h"
#include "bench/cluster/cluster_bench.h"
#include "cli/plots/svg.h"

namespace lfd::bench {
namespace {

constexpr double kWidth = 900, kHeight = 400, kTop = 50, kBottom = 60, kPanel = 340;
constexpr const char* kColors[] = {"#1f77b4", "#ff7f0e", "#2ca02c", "#d62728", "#9467bd", "#8c564b"};
constexpr const char* kGrid = "#dddddd";

// One panel: a value over the number of nodes, from zero.
struct Panel {
  double left, most_nodes, most_value;
  plots::Place at(double nodes, double value) const {
    return {left + kPanel * nodes / most_nodes, kHeight - kBottom - (kHeight - kTop - kBottom) * value / most_value};
  }
};

void draw_axes(plots::Svg& svg, const Panel& panel, const std::string& title, const std::vector<int>& nodes) {
  svg.text({panel.left, 28}, title, {.size_px = 14, .is_bold = true});
  const double step = std::pow(10, std::floor(std::log10(panel.most_value)));
  for (double value = 0; value <= panel.most_value; value += step) {
    svg.line(panel.at(0, value), panel.at(panel.most_nodes, value), {.stroke = kGrid});
    const plots::Place at = panel.at(0, value);
    svg.text({at.x - 6, at.y + 4}, fmt::format("{:g}", value), {.anchor = plots::Anchor::kEnd});
  }
  for (const int count : nodes) {
    const plots::Place at = panel.at(count, 0);
    svg.text({at.x, at.y + 18}, fmt::format("{}", count), {.anchor = plots::Anchor::kMiddle});
  }
  const plots::Place middle = panel.at(panel.most_nodes / 2, 0);
  svg.text({middle.x, middle.y + 40}, "nodes", {.anchor = plots::Anchor::kMiddle});
}

void draw_series(plots::Svg& svg, const Panel& panel, const ClusterTable& table, int modules, const char* color,
                 double ClusterRow::*value, double ClusterRow::*upper) {
  std::optional<plots::Place> last;
  for (const ClusterRow& row : table.rows) {
    if (row.modules != modules) continue;
    const plots::Place at = panel.at(row.nodes, row.*value);
    if (last) svg.line(*last, at, {.stroke = color, .width_px = 1.5});
    if (upper != nullptr) svg.line(at, panel.at(row.nodes, row.*upper), {.stroke = color, .dashes = "3 3"});
    svg.circle(at, 4, {.fill = color});
    last = at;
  }
}

}  // namespace

std::string svg_of(const ClusterTable& table) {
  double most_ms = 1, most_us = 1;
  int most_nodes = 1;
  for (const ClusterRow& row : table.rows) {
    most_ms = std::max(most_ms, row.shown_99_ms);
    most_us = std::max(most_us, row.controller_us);
    most_nodes = std::max(most_nodes, row.nodes);
  }
  plots::Svg svg(kWidth, kHeight);
  const Panel latency{70, most_nodes + 0.5, 1.1 * most_ms}, cost{520, most_nodes + 0.5, 1.1 * most_us};
  draw_axes(svg, latency, "begin to shown, ms: median, to 99 %", table.options.nodes);
  draw_axes(svg, cost, "the controller's processor time, us per frame", table.options.nodes);
  for (std::size_t i = 0; i < table.options.modules.size(); ++i) {
    const int modules = table.options.modules[i];
    const char* const color = kColors[i % std::size(kColors)];
    draw_series(svg, latency, table, modules, color, &ClusterRow::shown_median_ms, &ClusterRow::shown_99_ms);
    draw_series(svg, cost, table, modules, color, &ClusterRow::controller_us, nullptr);
    const double line = kTop + 14 + 18 * static_cast<double>(i);
    svg.circle({90, line - 4}, 5, {.fill = color});
    svg.text({102, line}, fmt::format("{} modules", modules), {});
  }
  return svg.finish();
}

}  // namespace lfd::bench
