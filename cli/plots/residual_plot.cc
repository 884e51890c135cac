// Arrows from seen pixels to mapped ones.
#include "cli/plots/residual_plot.h"

#include <algorithm>
#include <cmath>

#include "base/log.h"
#include "cli/plots/heat_map.h"

namespace lfd::plots {
namespace {

constexpr const char* kInk = "#1f5fbf";
constexpr const char* kOutlierInk = "#d62728";
constexpr const char* kNoMapInk = "#8a8a8a";

struct Residual {
  PixelPoint from;
  double du_px = 0, dv_px = 0;
  bool is_outlier = false, is_known = false;

  double length_px() const { return std::hypot(du_px, dv_px); }
};

std::vector<Residual> residuals_of(const DisplayCalibration& display, int module,
                                   const std::vector<SeenPoint>& points) {
  std::vector<Residual> residuals;
  for (const SeenPoint& point : points) {
    Residual residual{.from = point.in_image, .is_outlier = point.is_outlier};
    if (const auto p = image_from_screen(display, display.modules[static_cast<std::size_t>(module)], point.on_screen)) {
      residual.du_px = p->x - point.in_image.x;
      residual.dv_px = p->y - point.in_image.y;
      residual.is_known = true;
    }
    residuals.push_back(residual);
  }
  return residuals;
}

// Of what is neither an outlier nor without a map.
std::vector<double> lengths_of(const std::vector<Residual>& residuals) {
  std::vector<double> lengths;
  for (const Residual& residual : residuals) {
    if (residual.is_known && !residual.is_outlier) lengths.push_back(residual.length_px());
  }
  return lengths;
}

void draw_residual(Svg& svg, const Axes& axes, const Residual& residual, double scale) {
  const Place from = axes.at(residual.from.x, residual.from.y);
  if (residual.is_outlier) svg.circle(from, 4, {.stroke = kOutlierInk, .width_px = 1.5});
  if (!residual.is_known) {
    svg.line({from.x - 3, from.y - 3}, {from.x + 3, from.y + 3}, {.stroke = kNoMapInk});
    svg.line({from.x - 3, from.y + 3}, {from.x + 3, from.y - 3}, {.stroke = kNoMapInk});
    return;
  }
  const double times = residual.is_outlier ? 1 : scale;
  svg.arrow(from, axes.at(residual.from.x + times * residual.du_px, residual.from.y + times * residual.dv_px),
            residual.is_outlier ? kOutlierInk : kInk);
}

}  // namespace

std::string residuals(const DisplayCalibration& display, int module, const std::vector<SeenPoint>& points) {
  const std::vector<Residual> residuals = residuals_of(display, module, points);
  const std::vector<double> lengths = lengths_of(residuals);
  const double width = display.image.width, height = display.image.height;
  const double place_px = std::sqrt(width * height / static_cast<double>(std::max<std::size_t>(points.size(), 1)));
  const double longest = lengths.empty() ? 0 : *std::ranges::max_element(lengths);
  const double scale = arrow_scale(longest, place_px);
  const Range u{0, width}, v{height, 0};
  const Axes axes(with_equal_scales({90, 60, 760, 620}, u, v), u, v);
  const double bottom = axes.bottom_px();
  Svg svg(1060, bottom + 115);
  axes.draw_grid(svg);
  svg.begin_clip(axes.box());
  for (const Residual& residual : residuals) draw_residual(svg, axes, residual, scale);
  svg.end_group();
  axes.draw(svg, {fmt::format("{}, module {}: residuals of the fit", display.name, module), "u, px", "v, px"});
  draw_key(svg, {875, 70}, kInk, fmt::format("{:g} x their length", scale));
  draw_key(svg, {875, 94}, kOutlierInk, "outliers, true length");
  draw_key(svg, {875, 118}, kNoMapInk, "crosses: no map");
  const auto outliers = std::ranges::count_if(residuals, &Residual::is_outlier);
  svg.text({470, bottom + 66},
           "Arrows run from the pixel that was lit toward where the map has its light on the screen.",
           {.anchor = Anchor::kMiddle});
  svg.text({470, bottom + 88},
           fmt::format("{} observations, {} of them outliers. Residuals of the others, px: {}.", points.size(),
                       outliers, spread_text(lengths)),
           {.anchor = Anchor::kMiddle});
  return svg.finish();
}

}  // namespace lfd::plots
