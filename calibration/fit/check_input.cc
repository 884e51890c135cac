// Refusals that need no optimiser: places, repetitions, counts, lines.
#include "calibration/fit/check_input.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <tuple>

#include "base/log.h"
#include "calibration/fit/pinhole_family.h"

namespace lfd {
namespace {

constexpr std::size_t kLeastObservations = (kPinholeParameters + 1) / 2;  // each is two numbers

// Points whose spread across their main direction is below this share of that along it lie on a line.
constexpr double kLineShare = 0.01;

auto key(const Observation& o) {
  return std::tuple(o.in_image.x, o.in_image.y, o.on_screen.x, o.on_screen.y, o.sigma_px, o.line);
}

Status check_place(const DisplayCalibration& display, const Observation& o) {
  if (o.module < 0 || static_cast<std::size_t>(o.module) >= display.modules.size()) {
    return Error(fmt::format("module: {}; the display has modules 0 to {}", o.module, display.modules.size() - 1));
  }
  if (!contains(display.image, o.in_image)) {
    return Error(fmt::format("u, v: ({:g}, {:g}) px is outside the image of {} x {} px", o.in_image.x, o.in_image.y,
                             display.image.width, display.image.height));
  }
  return {};
}

// Standard deviations of the points, along their main direction and across it.
template <class Place>
std::pair<double, double> extents(const ModuleObservations& points, Place place) {
  const double count = static_cast<double>(points.size());
  glm::dvec2 mean(0);
  for (const Observation& o : points) mean += place(o) / count;
  double xx = 0, yy = 0, xy = 0;
  for (const Observation& o : points) {
    const glm::dvec2 d = place(o) - mean;
    xx += d.x * d.x / count;
    yy += d.y * d.y / count;
    xy += d.x * d.y / count;
  }
  // Eigenvalues of the covariance.
  const double middle = 0.5 * (xx + yy), half = std::hypot(0.5 * (xx - yy), xy);
  return {std::sqrt(middle + half), std::sqrt(std::max(0.0, middle - half))};
}

Status check_module(const ModuleObservations& points) {
  if (points.empty()) return Error("no observations");
  if (points.size() < kLeastObservations) {
    return Error(fmt::format("{} observations are {} numbers; a pinhole has {} parameters: at least {} are needed",
                             points.size(), 2 * points.size(), kPinholeParameters, kLeastObservations));
  }
  const auto in_image = extents(points, [](const Observation& o) { return glm::dvec2(o.in_image.x, o.in_image.y); });
  if (!(in_image.second > kLineShare * in_image.first)) {
    return Error(
        fmt::format("all observations lie on a line of the image: they spread by {:.3g} px along it and by "
                    "{:.2g} px across; what is beside it cannot be known",
                    in_image.first, in_image.second));
  }
  const auto on_screen = extents(points, [](const Observation& o) { return glm::dvec2(o.on_screen.x, o.on_screen.y); });
  if (!(on_screen.second > kLineShare * on_screen.first)) {
    return Error(
        fmt::format("all observations lie on a line of the screen: they spread by {:.3g} m along it and by "
                    "{:.2g} m across",
                    on_screen.first, on_screen.second));
  }
  return {};
}

}  // namespace

Result<std::vector<ModuleObservations>> observations_by_module(const DisplayCalibration& display,
                                                               const Observations& observations) {
  std::vector<ModuleObservations> modules(display.modules.size());
  for (const Observation& o : observations.points) {
    if (auto status = check_place(display, o); !status) return status.error().within(observations.place_of(o));
    modules[static_cast<std::size_t>(o.module)].push_back(o);
  }
  for (std::size_t k = 0; k < modules.size(); ++k) {
    ModuleObservations& points = modules[k];
    std::ranges::sort(points, {}, key);
    const auto same = [](const Observation& a, const Observation& b) {
      return a.in_image == b.in_image && a.on_screen == b.on_screen;
    };
    if (const auto repeated = std::ranges::adjacent_find(points, same); repeated != points.end()) {
      const auto [first, second] = std::minmax(repeated->line, std::next(repeated)->line);
      return Error(fmt::format("{}:{}: repeats the observation of line {}", observations.source, second, first));
    }
    if (auto status = check_module(points); !status) {
      return status.error().within(fmt::format("{}: module {}", observations.source, k));
    }
  }
  return modules;
}

}  // namespace lfd
