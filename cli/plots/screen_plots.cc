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
  Svg svg(900, 680);
  const Range x = across(display.screen.width_m), y = across(display.screen.height_m);
  const Axes axes(with_equal_scales({90, 90, 640, 480}, x, y), x, y);
  Field field{report.sampling.screen_columns, report.sampling.screen_rows, {}};
  for (const int count : report.lit_by) field.value.push_back(count == 0 ? kNone : count);
  const ColourScale scale{0, static_cast<double>(display.modules.size()), false};
  svg.rectangle(axes.box(), {.fill = "#000000"});
  draw_field(svg, axes, field, scale);
  axes.draw(svg, {fmt::format("{}: how many of {} modules light each place of the screen", display.name,
                              display.modules.size()),
                  "s, m (right as a viewer sees it)", "y, m"});
  draw_scale(svg, {770, 110, 18, 300}, scale, "modules");
  draw_key(svg, {770, 440}, "#000000", "none");
  const int darkest = report.least_covering();
  svg.text(
      {410, 640},
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
  std::vector<Field> fields;
  std::vector<double> all;
  for (const auto& [distance, name] : slices) {
    fields.push_back(condition_field(display, module, distance));
    all.insert(all.end(), fields.back().value.begin(), fields.back().value.end());
  }
  const ColourScale scale = scale_for(all);
  Svg svg(1340, 470);
  svg.text({610, 30}, fmt::format("{}, module {}: condition number of d(image)/d(physical)", display.name, module),
           {.size_px = 16, .anchor = Anchor::kMiddle, .is_bold = true});
  const Range x = across(display.screen.width_m), y = across(display.screen.height_m);
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const Box box{80 + 390.0 * static_cast<double>(i), 80, 310, 280};
    const Axes axes(with_equal_scales(box, x, y), x, y);
    svg.rectangle(axes.box(), {.fill = "#d9d9d9"});
    draw_field(svg, axes, fields[i], scale);
    axes.draw(svg, {slices[i].second, "s, m", "y, m"});
    svg.text({box.x + box.width / 2, 420}, spread_text(fields[i].value), {.size_px = 11, .anchor = Anchor::kMiddle});
  }
  draw_scale(svg, {1230, 90, 18, 250}, scale, scale.is_logarithmic ? "condition (log)" : "condition");
  draw_key(svg, {1230, 365}, "#d9d9d9", "no image");
  svg.text({610, 450}, "1: all directions are stretched alike; large: a small step in space moves the image far.",
           {.size_px = 11, .anchor = Anchor::kMiddle});
  return svg.finish();
}

}  // namespace lfd::plots
