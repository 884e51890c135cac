// What lies over the screen: coverage, and condition numbers at three depths.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/log.h"
#include "calibration/check/derivatives.h"
#include "cli/plots/check_plots.h"
#include "cli/plots/heat_map.h"

namespace lfd::plots {
namespace {

constexpr int kColumns = 40, kRows = 28;  // of a condition map
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

Range across(double size_m) { return {-size_m / 2, size_m / 2}; }

Field condition_field(const DisplayCalibration& display, int module, double distance_m) {
  const ModuleCalibration& calibration = display.modules[static_cast<std::size_t>(module)];
  Field field{kColumns, kRows, {}};
  CheckSampling sampling;
  sampling.screen_columns = kColumns;
  sampling.screen_rows = kRows;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const ScreenPoint s = sampled_screen_point(display, sampling, column, row);
      const auto p = point_before_screen(display.optics, s, distance_m);
      field.value.push_back(condition_at(display, calibration, p).value_or(kNone));
    }
  }
  return field;
}

}  // namespace

std::string coverage(const DisplayCalibration& display, const CalibrationReport& report) {
  const Range x = across(display.screen.width_m), y = across(display.screen.height_m);
  const Axes axes(with_equal_scales({90, 60, 640, 480}, x, y), x, y);
  Field field{report.sampling.screen_columns, report.sampling.screen_rows, {}};
  for (const int count : report.lit_by) field.value.push_back(count == 0 ? kNone : count);
  const auto modules = static_cast<double>(display.modules.size());
  const double least = *std::ranges::min_element(report.lit_by);
  const ColourScale scale{std::min(least, modules - 1), modules, false, true};
  Svg svg(900, std::max(axes.bottom_px() + 90, 450.0));
  svg.rectangle(axes.box(), {.fill = "#000000"});
  draw_field(svg, axes, field, scale);
  axes.draw(svg, {fmt::format("{}: how many of {} modules light each place of the screen", display.name,
                              display.modules.size()),
                  "s, m (right as a viewer sees it)", "y, m"});
  draw_scale(svg, {780, 80, 18, 280}, scale, "modules");
  draw_key(svg, {780, 385}, "#000000", "none");
  const int darkest = report.least_covering();
  svg.text(
      {410, axes.bottom_px() + 66},
      fmt::format("Modules light {:.2f} % of the screen in the mean, module {} the least, {:.2f} %; {:.2f} % is lit "
                  "by any.",
                  100 * report.all.coverage, darkest, 100 * report.modules[static_cast<std::size_t>(darkest)].coverage,
                  100 * report.coverage_any),
      {.anchor = Anchor::kMiddle});
  return svg.finish();
}

std::string condition(const DisplayCalibration& display, const CalibrationReport& report, int module) {
  const double depth = report.half_depth_m;
  const std::pair<double, std::string> slices[] = {{-depth, fmt::format("{:.3g} m behind the screen", depth)},
                                                   {0, "on the screen"},
                                                   {depth, fmt::format("{:.3g} m before the screen", depth)}};
  const Range x = across(display.screen.width_m), y = across(display.screen.height_m);
  std::vector<Field> fields;
  std::vector<Axes> axes;
  std::vector<double> all;
  for (const auto& [distance, name] : slices) {
    const Box box{80 + 390.0 * static_cast<double>(axes.size()), 90, 310, 310};
    axes.emplace_back(with_equal_scales(box, x, y), x, y);
    fields.push_back(condition_field(display, module, distance));
    all.insert(all.end(), fields.back().value.begin(), fields.back().value.end());
  }
  const ColourScale scale = scale_for(all);
  const double bottom = axes.front().bottom_px();
  Svg svg(1340, std::max(bottom + 110, 390.0));
  svg.text({610, 30}, fmt::format("{}, module {}: condition number of d(image)/d(physical)", display.name, module),
           {.size_px = 16, .anchor = Anchor::kMiddle, .is_bold = true});
  for (std::size_t i = 0; i < fields.size(); ++i) {
    svg.rectangle(axes[i].box(), {.fill = "#d9d9d9"});
    draw_field(svg, axes[i], fields[i], scale);
    axes[i].draw(svg, {slices[i].second, "s, m", "y, m"});
    svg.text({axes[i].box().x + axes[i].box().width / 2, bottom + 60}, spread_text(fields[i].value),
             {.size_px = 11, .anchor = Anchor::kMiddle});
  }
  draw_scale(svg, {1235, 90, 18, 230}, scale, scale.is_logarithmic ? "condition (log)" : "condition");
  svg.text({1235, 340}, "brightest: and more", {.size_px = 10});
  draw_key(svg, {1235, 355}, "#d9d9d9", "no image");
  svg.text({610, bottom + 88},
           "1: all directions are stretched alike; large: a small step in space moves the image far.",
           {.size_px = 11, .anchor = Anchor::kMiddle});
  return svg.finish();
}

}  // namespace lfd::plots
