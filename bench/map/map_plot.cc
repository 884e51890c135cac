// Error over time as an SVG picture.
#include <algorithm>
#include <cmath>

#include "base/log.h"
#include "bench/map/map_bench.h"

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

std::string grid_lines(const Axis& x, const Axis& y) {
  std::string svg;
  for (double decade = std::ceil(y.low); decade <= y.high; ++decade) {
    const double at = y.at(std::pow(10, decade));
    svg += fmt::format(
        "<line x1='{:.1f}' y1='{:.1f}' x2='{:.1f}' y2='{:.1f}' stroke='#ddd'/><text x='{:.1f}' y='{:.1f}' "
        "text-anchor='end'>1e{}</text>\n",
        x.from_px, at, x.to_px, at, x.from_px - 6, at + 4, static_cast<int>(decade));
  }
  for (const double value : {0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0, 20.0, 50.0}) {
    if (std::log10(value) < x.low || std::log10(value) > x.high) continue;
    const double at = x.at(value);
    svg += fmt::format(
        "<line x1='{:.1f}' y1='{:.1f}' x2='{:.1f}' y2='{:.1f}' stroke='#ddd'/><text x='{:.1f}' y='{:.1f}' "
        "text-anchor='middle'>{}</text>\n",
        at, y.from_px, at, y.to_px, at, y.from_px + 18, value);
  }
  return svg;
}

}  // namespace

std::string svg_of(const MapTable& table) {
  double least = 1, most = 2, best = 1e-7, worst = 1e-3;
  std::vector<std::string> names;
  for (const MapRow& r : table.rows) {
    least = std::min(least, r.wall_ratio);
    most = std::max(most, r.wall_ratio);
    best = std::min(best, std::max(r.truth.percent_999, 1e-9));
    worst = std::max(worst, r.truth.percent_999);
    if (std::ranges::find(names, r.variant) == names.end()) names.push_back(r.variant);
  }
  const Axis x{std::log10(least) - 0.1, std::log10(most) + 0.1, kLeft, kWidth - kRight};
  const Axis y{std::floor(std::log10(best)), std::ceil(std::log10(worst)), kHeight - kBottom, kTop};
  std::string svg = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' width='{0}' height='{1}' font-family='sans-serif' font-size='12'>\n"
      "<rect width='{0}' height='{1}' fill='white'/>\n<text x='{2}' y='24' font-size='15'>Position error over time: "
      "{3} on {4}</text>\n",
      kWidth, kHeight, kLeft, table.scene, table.display);
  svg += grid_lines(x, y);
  const double bound = y.at(MapBounds().percent_999), twice = x.at(MapBounds().ratio);
  svg += fmt::format(
      "<line x1='{0:.1f}' y1='{1:.1f}' x2='{2:.1f}' y2='{1:.1f}' stroke='#c00' stroke-dasharray='6 4'/>\n"
      "<line x1='{3:.1f}' y1='{4:.1f}' x2='{3:.1f}' y2='{5:.1f}' stroke='#c00' stroke-dasharray='6 4'/>\n",
      x.from_px, bound, x.to_px, twice, y.from_px, y.to_px);
  svg += fmt::format(
      "<text x='{:.1f}' y='{:.1f}' text-anchor='middle'>wall-clock time over that of plain vertices</text>\n",
      0.5 * (x.from_px + x.to_px), kHeight - 18.0);
  svg += fmt::format(
      "<text transform='translate(22 {:.1f}) rotate(-90)' text-anchor='middle'>99.9 % position error / ROI "
      "diagonal</text>\n",
      0.5 * (y.from_px + y.to_px));
  const std::uint32_t first_module = table.rows.empty() ? 0 : table.rows.front().module;
  for (const MapRow& r : table.rows) {
    const auto color =
        static_cast<std::size_t>(std::ranges::find(names, r.variant) - names.begin()) % std::size(kColors);
    const double px = x.at(r.wall_ratio), py = y.at(std::max(r.truth.percent_999, 1e-9));
    svg += r.module == first_module
               ? fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='6' fill='{}'/>\n", px, py, kColors[color])
               : fmt::format(
                     "<rect x='{:.1f}' y='{:.1f}' width='10' height='10' fill='none' stroke-width='2' stroke='{}'/>\n",
                     px - 5, py - 5, kColors[color]);
  }
  double line = kTop + 8;
  for (std::size_t i = 0; i < names.size(); ++i, line += 19) {
    svg += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='5' fill='{}'/><text x='{:.1f}' y='{:.1f}'>{}</text>\n",
                       x.to_px + 18, line - 4, kColors[i % std::size(kColors)], x.to_px + 30, line, names[i]);
  }
  svg +=
      fmt::format("<text x='{:.1f}' y='{:.1f}' fill='#666'>disc: module {}; square: the others; red: bounds</text>\n",
                  x.to_px + 12, line + 12, first_module);
  return svg + "</svg>\n";
}

}  // namespace lfd::bench
