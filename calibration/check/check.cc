// A calibration's numbers: every module's, then all together.
#include "calibration/check/check.h"

#include <algorithm>
#include <cmath>

#include "calibration/check/module_samples.h"

namespace lfd {
namespace {

constexpr double kWidest_rad = 3;  // just less than a half circle

int index_of(std::vector<MapNumbers>::const_iterator found, const std::vector<MapNumbers>& modules) {
  return static_cast<int>(found - modules.begin());
}

// What cannot be pooled is the mean over modules; so are the shares of cells.
void add_means(CalibrationReport& report) {
  const auto count = static_cast<double>(report.modules.size());
  for (const MapNumbers& module : report.modules) {
    report.all.coverage += module.coverage / count;
    report.all.folded += module.folded / count;
    report.all.incomplete += module.incomplete / count;
  }
}

std::optional<DepthBudget> budget_of(const DisplayCalibration& display, const CalibrationReport& report) {
  if (!(report.pixel_width_m > 0)) return std::nullopt;
  const double angle = report.angles.from_centre ? report.angles.from_centre->median_rad
                                                 : std::min(display.angular_scattering_rad / 1.5, kWidest_rad);
  return depth_budget(report.pixel_width_m, angle, display.optics.observer_distance_m / 2);
}

}  // namespace

int CalibrationReport::worst_by(double MapNumbers::*field) const {
  return index_of(std::ranges::max_element(modules, {}, field), modules);
}

int CalibrationReport::least_covering() const {
  return index_of(std::ranges::min_element(modules, {}, &MapNumbers::coverage), modules);
}

double default_half_depth_m(const DisplayCalibration& display) {
  double depth = std::min(0.25 * display.screen.width_m, 0.5 * display.optics.observer_distance_m);
  for (const ModuleCalibration& module : display.modules) depth = std::min(depth, -0.5 * module.emitter.z);
  return depth;
}

CalibrationReport check_calibration(const DisplayCalibration& display, double half_depth_m,
                                    const CheckSampling& sampling) {
  CalibrationReport report;
  report.sampling = sampling;
  report.half_depth_m = half_depth_m;
  report.lit_by.assign(static_cast<std::size_t>(sampling.screen_columns * sampling.screen_rows), 0);
  ModuleSamples all;
  for (const ModuleCalibration& module : display.modules) {
    ModuleSamples samples = sample_module(display, module, half_depth_m, sampling);
    for (std::size_t i = 0; i < samples.lit.size(); ++i) report.lit_by[i] += samples.lit[i] ? 1 : 0;
    all.append(samples);
    report.modules.push_back(numbers_of(samples));
  }
  report.all = numbers_of(all);
  add_means(report);
  const auto dark = std::ranges::count(report.lit_by, 0);
  report.coverage_any = 1 - share_of(static_cast<std::size_t>(dark), report.lit_by.size());
  report.pixel_width_m = quantile(all.pixel_widths_m, 0.5);
  report.angles = check_angles(display);
  report.depth = budget_of(display, report);
  return report;
}

ScreenPoint sampled_screen_point(const DisplayCalibration& display, const CheckSampling& sampling, int column,
                                 int row) {
  return {((column + 0.5) / sampling.screen_columns - 0.5) * display.screen.width_m,
          ((row + 0.5) / sampling.screen_rows - 0.5) * display.screen.height_m};
}

PixelPoint sampled_pixel(const DisplayCalibration& display, const CheckSampling& sampling, int column, int row) {
  return {(column + 0.5) * display.image.width / sampling.image_columns,
          (row + 0.5) * display.image.height / sampling.image_rows};
}

}  // namespace lfd
