// A calibration's numbers, taken by sampling.
#include "calibration/check.h"

#include <algorithm>
#include <cmath>
#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "base/log.h"

namespace lfd {
namespace {

constexpr int kImageColumns = 48, kImageRows = 36;
constexpr int kScreenColumns = 65, kScreenRows = 49;
constexpr int kBoxPoints = 9;   // along each axis
constexpr double kStep = 1e-6;  // of differences, as a share of the screen's size
constexpr double kSqueezed = 1e3;

template <class M>
double frobenius(const M& m) {
  double sum = 0;
  for (int column = 0; column < m.length(); ++column) sum += glm::dot(m[column], m[column]);
  return std::sqrt(sum);
}

// Frobenius condition number over the dimension: 1 for rotations, infinity for singular matrices.
template <class M>
double condition(const M& m) {
  const double number = frobenius(m) * frobenius(glm::inverse(m)) / M::length();
  return std::isfinite(number) ? number : std::numeric_limits<double>::infinity();
}

double quantile(std::vector<double>& values, double share) {
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// Metres on the screen, y up, of a position in the image of the ideal map.
glm::dvec2 on_ideal_screen(const DisplayCalibration& display, double u, double v) {
  const ScreenPoint s = screen_from_image(IdealMap{}, display.screen, display.image, {u, v});
  return {s.x, s.y};
}

// The derivative of the module's map against the ideal one: the identity for the ideal map. Absent at the map's border.
std::optional<glm::dmat2> screen_derivative(const DisplayCalibration& display, const ModuleCalibration& module,
                                            ScreenPoint s) {
  glm::dmat2 derivative;
  const glm::dvec2 step = kStep * glm::dvec2(display.screen.width_m, display.screen.height_m);
  for (int axis = 0; axis < 2; ++axis) {
    const glm::dvec2 d = axis == 0 ? glm::dvec2(step.x, 0) : glm::dvec2(0, step.y);
    const auto after = image_from_screen(display, module, {s.x + d.x, s.y + d.y});
    const auto before = image_from_screen(display, module, {s.x - d.x, s.y - d.y});
    if (!after || !before) return std::nullopt;
    derivative[axis] = (on_ideal_screen(display, after->x, after->y) - on_ideal_screen(display, before->x, before->y)) /
                       (2 * step[axis]);
  }
  return derivative;
}

// The same of the whole map, with z; absent at its border.
std::optional<glm::dmat3> physical_derivative(const DisplayCalibration& display, const ModuleCalibration& module,
                                              Point3<Physical> p) {
  glm::dmat3 derivative;
  const double step = kStep * display.screen.width_m;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 d(0.0);
    d[axis] = step;
    const auto after = image_from_physical(display, module, point_of<Physical>(to_glm(p) + d));
    const auto before = image_from_physical(display, module, point_of<Physical>(to_glm(p) - d));
    if (!after || !before) return std::nullopt;
    const glm::dvec2 moved =
        on_ideal_screen(display, after->u, after->v) - on_ideal_screen(display, before->u, before->v);
    derivative[axis] = glm::dvec3(moved, after->z - before->z) / (2 * step);
  }
  return derivative;
}

// What is gathered over all modules before it becomes shares and quantiles.
struct Samples {
  std::vector<double> round_trip_px;
  std::size_t image_points = 0, derivatives = 0, mirrored = 0, near_singular = 0;
  std::vector<double> conditions;
  std::vector<bool> lit = std::vector<bool>(kScreenColumns * kScreenRows, false);
};

void sample_image(const DisplayCalibration& display, const ModuleCalibration& module, Samples& samples) {
  for (int row = 0; row < kImageRows; ++row) {
    for (int column = 0; column < kImageColumns; ++column) {
      const PixelPoint p{(column + 0.5) * display.image.width / kImageColumns,
                         (row + 0.5) * display.image.height / kImageRows};
      ++samples.image_points;
      const auto s = screen_from_image(display, module, p);
      if (!s) continue;
      const auto back = image_from_screen(display, module, *s);
      samples.round_trip_px.push_back(back ? std::hypot(back->x - p.x, back->y - p.y)
                                           : std::numeric_limits<double>::infinity());
      const auto derivative = screen_derivative(display, module, *s);
      if (!derivative) continue;
      ++samples.derivatives;
      if (!(glm::determinant(*derivative) > 0)) ++samples.mirrored;
      if (!(condition(*derivative) < kSqueezed)) ++samples.near_singular;
    }
  }
}

// Share of the screen that the module lights.
double sample_screen(const DisplayCalibration& display, const ModuleCalibration& module, Samples& samples) {
  int lit = 0;
  for (int row = 0; row < kScreenRows; ++row) {
    for (int column = 0; column < kScreenColumns; ++column) {
      const ScreenPoint s{((column + 0.5) / kScreenColumns - 0.5) * display.screen.width_m,
                          ((row + 0.5) / kScreenRows - 0.5) * display.screen.height_m};
      if (!image_from_screen(display, module, s)) continue;
      ++lit;
      samples.lit[static_cast<std::size_t>(row * kScreenColumns + column)] = true;
    }
  }
  return static_cast<double>(lit) / (kScreenColumns * kScreenRows);
}

void sample_box(const DisplayCalibration& display, const ModuleCalibration& module, double half_depth_m,
                Samples& samples) {
  const glm::dvec3 size(display.screen.width_m, display.screen.height_m, 2 * half_depth_m);
  for (int i = 0; i < kBoxPoints * kBoxPoints * kBoxPoints; ++i) {
    const glm::dvec3 share(i % kBoxPoints, i / kBoxPoints % kBoxPoints, i / (kBoxPoints * kBoxPoints));
    const auto p = point_of<Physical>(size * (share / double(kBoxPoints - 1) - 0.5));
    if (const auto derivative = physical_derivative(display, module, p))
      samples.conditions.push_back(condition(*derivative));
  }
}

double share_of(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

double default_half_depth_m(const DisplayCalibration& display) { return 0.25 * display.screen.width_m; }

CalibrationReport check_calibration(const DisplayCalibration& display, double half_depth_m) {
  Samples samples;
  CalibrationReport report;
  report.half_depth_m = half_depth_m;
  report.coverage_least = 1;
  for (std::size_t k = 0; k < display.modules.size(); ++k) {
    sample_image(display, display.modules[k], samples);
    sample_box(display, display.modules[k], half_depth_m, samples);
    const double coverage = sample_screen(display, display.modules[k], samples);
    report.coverage_mean += coverage / static_cast<double>(display.modules.size());
    if (coverage < report.coverage_least) {
      report.coverage_least = coverage;
      report.coverage_least_module = static_cast<int>(k);
    }
  }
  report.image_on_screen = share_of(samples.round_trip_px.size(), samples.image_points);
  report.round_trip_median_px = quantile(samples.round_trip_px, 0.5);
  report.round_trip_999_px = quantile(samples.round_trip_px, 0.999);
  report.round_trip_max_px = quantile(samples.round_trip_px, 1);
  report.mirrored = share_of(samples.mirrored, samples.derivatives);
  report.near_singular = share_of(samples.near_singular, samples.derivatives);
  report.condition_median = quantile(samples.conditions, 0.5);
  report.condition_max = quantile(samples.conditions, 1);
  const auto lit = std::count(samples.lit.begin(), samples.lit.end(), true);
  report.coverage_any = share_of(static_cast<std::size_t>(lit), samples.lit.size());
  return report;
}

std::vector<std::string> missed_limits(const CalibrationReport& report, const AcceptanceLimits& limits) {
  std::vector<std::string> missed;
  const auto at_most = [&missed](const char* what, double value, double limit) {
    if (!(value <= limit)) missed.push_back(fmt::format("{} {:.4g}; at most {:.4g} is accepted", what, value, limit));
  };
  at_most("round trip: max px", report.round_trip_max_px, limits.round_trip_max_px);
  at_most("mirrored share of the image", report.mirrored, limits.mirrored);
  at_most("near singular share of the image", report.near_singular, limits.near_singular);
  at_most("condition number", report.condition_max, limits.condition_max);
  if (!(report.coverage_least >= limits.coverage_least)) {
    missed.push_back(fmt::format("coverage: module {} lights {:.4g} of the screen; at least {:.4g} is accepted",
                                 report.coverage_least_module, report.coverage_least, limits.coverage_least));
  }
  return missed;
}

}  // namespace lfd
