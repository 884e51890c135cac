// Sampling one module's map over its image, the screen and the box.
#include "calibration/check/module_samples.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "calibration/check/derivatives.h"

namespace lfd {
namespace {

constexpr double kSqueezed = 1e3;

void add_derivative(const DisplayCalibration& display, const glm::dmat2& derivative, ModuleSamples& samples) {
  ++samples.derivatives;
  if (!(glm::determinant(derivative) > 0)) ++samples.mirrored;
  if (!(condition_number(derivative) < kSqueezed)) ++samples.near_singular;
  const double width = glm::length(glm::inverse(derivative)[0]) * display.screen.width_m / display.image.width;
  if (std::isfinite(width)) samples.pixel_widths_m.push_back(width);
}

void sample_image(const DisplayCalibration& display, const ModuleCalibration& module, const CheckSampling& sampling,
                  ModuleSamples& samples) {
  for (int row = 0; row < sampling.image_rows; ++row) {
    for (int column = 0; column < sampling.image_columns; ++column) {
      const PixelPoint p = sampled_pixel(display, sampling, column, row);
      ++samples.image_points;
      const auto s = screen_from_image(display, module, p);
      if (!s) {
        if (!lit_by(display, module.map, p)) ++samples.unmapped;  // neither on the screen nor beside it
        continue;
      }
      if (!line_of_screen_point(display.optics, module.emitter, *s)) ++samples.unmapped;
      const auto back = image_from_screen(display, module, *s);
      samples.round_trip_px.push_back(back ? std::hypot(back->x - p.x, back->y - p.y)
                                           : std::numeric_limits<double>::infinity());
      if (const auto derivative = derivative_by_screen(display, module, *s)) {
        add_derivative(display, *derivative, samples);
      }
    }
  }
}

void sample_screen(const DisplayCalibration& display, const ModuleCalibration& module, const CheckSampling& sampling,
                   ModuleSamples& samples) {
  for (int row = 0; row < sampling.screen_rows; ++row) {
    for (int column = 0; column < sampling.screen_columns; ++column) {
      const ScreenPoint s = sampled_screen_point(display, sampling, column, row);
      samples.lit.push_back(image_from_screen(display, module, s).has_value() &&
                            line_of_screen_point(display.optics, module.emitter, s).has_value());
    }
  }
}

void sample_box(const DisplayCalibration& display, const ModuleCalibration& module, double half_depth_m,
                const CheckSampling& sampling, ModuleSamples& samples) {
  const int points = sampling.box_points;
  const auto along = [points](int i) { return static_cast<double>(i) / (points - 1) - 0.5; };
  for (int i = 0; i < points * points * points; ++i) {
    const glm::dvec3 share(along(i % points), along(i / points % points), along(i / (points * points)));
    const auto p =
        sampling.roi
            ? point_of<Physical>(to_glm(sampling.roi->centre) + share * sampling.roi->size)
            : point_before_screen(display.optics, {display.screen.width_m * share.x, display.screen.height_m * share.y},
                                  2 * half_depth_m * share.z);
    if (const auto condition = condition_at(display, module, p)) samples.conditions.push_back(*condition);
  }
}

}  // namespace

void ModuleSamples::append(const ModuleSamples& other) {
  const auto add = [](std::vector<double>& to, const std::vector<double>& more) {
    to.insert(to.end(), more.begin(), more.end());
  };
  add(round_trip_px, other.round_trip_px);
  add(conditions, other.conditions);
  add(pixel_widths_m, other.pixel_widths_m);
  image_points += other.image_points;
  unmapped += other.unmapped;
  derivatives += other.derivatives;
  mirrored += other.mirrored;
  near_singular += other.near_singular;
}

ModuleSamples sample_module(const DisplayCalibration& display, const ModuleCalibration& module, double half_depth_m,
                            const CheckSampling& sampling) {
  ModuleSamples samples;
  sample_image(display, module, sampling, samples);
  sample_screen(display, module, sampling, samples);
  sample_box(display, module, half_depth_m, sampling, samples);
  if (const auto* grid = std::get_if<GridMap>(&module.map)) {
    samples.folded = grid->folded_share();
    samples.incomplete = 1 - grid->complete_share();
  }
  return samples;
}

MapNumbers numbers_of(ModuleSamples& samples) {
  MapNumbers numbers;
  numbers.round_trip_median_px = quantile(samples.round_trip_px, 0.5);
  numbers.round_trip_999_px = quantile(samples.round_trip_px, 0.999);
  numbers.round_trip_max_px = quantile(samples.round_trip_px, 1);
  numbers.image_on_screen = share_of(samples.round_trip_px.size(), samples.image_points);
  numbers.image_unmapped = share_of(samples.unmapped, samples.image_points);
  numbers.mirrored = share_of(samples.mirrored, samples.derivatives);
  numbers.near_singular = share_of(samples.near_singular, samples.derivatives);
  numbers.folded = samples.folded;
  numbers.incomplete = samples.incomplete;
  numbers.condition_median = quantile(samples.conditions, 0.5);
  numbers.condition_99 = quantile(samples.conditions, 0.99);
  numbers.condition_max = quantile(samples.conditions, 1);
  const auto lit = std::count(samples.lit.begin(), samples.lit.end(), true);
  numbers.coverage = share_of(static_cast<std::size_t>(lit), samples.lit.size());
  return numbers;
}

double quantile(std::vector<double>& values, double share) {
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double share_of(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace lfd
