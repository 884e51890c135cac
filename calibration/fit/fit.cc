// The fit as a whole: parts the observations, fits pinholes, adds grids, tells what was found.
#include "calibration/fit/fit.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/log.h"
#include "calibration/fit/determined.h"
#include "calibration/fit/residual_grid.h"
#include "calibration/fit/start.h"

namespace lfd {
namespace {

constexpr double kEmitterSdShare = 0.005;  // of the distance from the screen
constexpr double kGridTolerance = 0.1;     // of the noise
constexpr double kLeastGridTolerance_px = 1e-3;

Result<std::vector<PinholeFamily>> families_of(const DisplayCalibration& start, const FitOptions& options) {
  std::vector<PinholeFamily> families;
  for (std::size_t k = 0; k < start.modules.size(); ++k) {
    const ModuleCalibration& module = start.modules[k];
    const auto pinhole = start_pinhole(start, module);
    if (!pinhole) return pinhole.error().within(fmt::format("start: module {}", k));
    families.emplace_back(*pinhole, start.image, options.emitter_sd_m.value_or(kEmitterSdShare * -module.emitter.z));
  }
  return families;
}

// The residuals of a module's pinhole, each at the place where its point was seen.
std::vector<ResidualSample> samples_of(const FittedPinhole& fitted, const ModuleObservations& points) {
  std::vector<ResidualSample> samples;
  for (const Observation& seen : points) {
    const auto residual = pinhole_residual(fitted.family, fitted.z, fitted.curvature, seen);
    LFD_CHECK(residual, "the fit has seen every observation");
    samples.push_back({seen.in_image, *residual, seen.sigma_px});
  }
  return samples;
}

// Where the grid sees each observation's screen point, against where it was seen, px. Beside the grid its field says.
std::vector<double> grid_distances(const GridMap& grid, const ResidualField& field, const ModuleObservations& points,
                                   const std::vector<ResidualSample>& samples) {
  std::vector<double> distances;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PixelPoint seen = points[i].in_image;
    const auto p = image_from_screen(grid, points[i].on_screen);
    distances.push_back(p ? std::hypot(p->x - seen.x, p->y - seen.y)
                          : glm::length(samples[i].residual_px - field.at(seen)));
  }
  return distances;
}

ResidualSummary summary_of(std::vector<double> distances) {
  std::ranges::sort(distances);
  const auto quantile = [&](double share) {
    return distances[static_cast<std::size_t>(share * static_cast<double>(distances.size() - 1))];
  };
  return {quantile(0.5), quantile(0.99), distances.back()};
}

constexpr double kMostRadiusDeviations = 5;  // of the prior: e times the start's radius, or a part of it

// Of the screen, 1/m; 0: planar.
double curvature_of(const DisplayCalibration& display) {
  const double radius = display.optics.screen_radius_m;
  return radius == 0 ? 0 : 1 / radius;
}

struct FittedModule {
  ScreenMap map;
  std::vector<double> distances;  // of each observation, px
  // Least robust standard deviation of the residuals, in sigmas: a supple field follows the noise, and what is held out
  // of it tells more.
  double least_scale = 0;
  ModuleFit fit;
};

bool is_warped(const FittedModule& module) { return module.fit.is_grid; }

// The pinhole, or the grid of pinhole and residual field where that is better at points held out.
FittedModule fit_map(const FittedPinhole& fitted, const ModuleObservations& points, ImageSize image,
                     bool residual_grids) {
  const std::vector<ResidualSample> samples = samples_of(fitted, points);
  FittedModule module{fitted.family.at(fitted.z), {}, 0, {}};
  for (const ResidualSample& sample : samples) module.distances.push_back(glm::length(sample.residual_px));
  if (!residual_grids) return module;
  const auto smoothed = smooth_residuals(image, samples);
  if (!smoothed) return module;
  module.fit.held_out_pinhole_px = smoothed->held_out_without_px;
  module.fit.held_out_field_px = smoothed->held_out_with_px;
  if (!smoothed->is_better || smoothed->held_out_without_px < kLeastGridTolerance_px) return module;
  const double tolerance = std::max(kGridTolerance * smoothed->held_out_with_px, kLeastGridTolerance_px);
  const auto grid = residual_grid(fitted, smoothed->field, image, tolerance);
  if (!grid) return module;
  module.distances = grid_distances(*grid, smoothed->field, points, samples);
  module.map = *grid;
  module.least_scale = smoothed->held_out_spread;
  module.fit.is_grid = true;
  return module;
}

// Fills in what the distances tell; returns the outliers.
std::vector<Outlier> judge(FittedModule& module, const PinholeFamily& family, double start_curvature,
                           const ModuleObservations& points, bool sigmas_are_known) {
  std::vector<double> scaled;
  for (std::size_t i = 0; i < points.size(); ++i) scaled.push_back(module.distances[i] / points[i].sigma_px);
  const double least = sigmas_are_known ? std::max(1.0, module.least_scale) : module.least_scale;
  const double scale = std::max(least, robust_spread(std::move(scaled)));
  std::vector<Outlier> outliers;
  std::vector<double> before, after;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (module.distances[i] > std::max(kOutlierSigmas * scale * points[i].sigma_px, kLeastOutlier_px)) {
      outliers.push_back({points[i].module, points[i].line, module.distances[i]});
      continue;
    }
    after.push_back(module.distances[i]);
    const auto at_start = pinhole_residual(family, PinholeVector{}, start_curvature, points[i]);
    LFD_CHECK(at_start, "the fit began by seeing every observation");
    before.push_back(glm::length(*at_start));
  }
  module.fit.observations = points.size();
  module.fit.outliers = outliers.size();
  module.fit.noise_px = robust_spread(after);
  module.fit.before = summary_of(std::move(before));
  module.fit.after = summary_of(std::move(after));
  return outliers;
}

// All modules with one curvature.
struct Solution {
  PinholeFit pinholes;
  Determined determined;
  std::vector<FittedModule> modules;
};

Result<Solution> solve(std::span<const PinholeFamily> families, std::span<const ModuleObservations> lists,
                       const DisplayCalibration& start, Curvature curvature, bool sigmas_are_known,
                       bool residual_grids) {
  const double start_curvature = curvature_of(start);
  Solution solution;
  LFD_TRY(solution.pinholes, fit_pinholes(families, lists, start_curvature, curvature, sigmas_are_known));
  LFD_TRY(solution.determined, determined_by(families, lists, start_curvature, solution.pinholes));
  for (std::size_t k = 0; k < families.size(); ++k) {
    const FittedPinhole fitted{families[k], solution.pinholes.z[k], solution.pinholes.curvature};
    solution.modules.push_back(fit_map(fitted, lists[k], start.image, residual_grids));
  }
  return solution;
}

// Observations of maps that no lens on this cylinder makes are met best by some other cylinder, which then is nobody's.
Status check_radius(double start_m, double found_m, const std::string& source) {
  const double deviations = std::abs(std::log(std::abs(found_m / start_m))) / kCurvatureSd;
  if (deviations <= kMostRadiusDeviations) return {};
  return Error(fmt::format(
      "{}: a screen radius of {:.4g} m fits best, {:.3g} standard deviations from the start's {:.4g} m; the "
      "start is another display's, or its modules are no pinholes on a cylinder",
      source, found_m, deviations, start_m));
}

}  // namespace

Result<FittedDisplay> fit_display(const DisplayCalibration& start, const Observations& observations,
                                  const FitOptions& options) {
  if (const double sd = options.emitter_sd_m.value_or(1); !(sd > 0) || !std::isfinite(sd)) {
    return Error(fmt::format("standard deviation of the emitters: {} m must be positive and finite", sd));
  }
  LFD_TRY(const std::vector<ModuleObservations> lists, observations_by_module(start, observations));
  LFD_TRY(const std::vector<PinholeFamily> families, families_of(start, options));
  const auto solved = [&](Curvature curvature) {
    return solve(families, lists, start, curvature, observations.has_sigma, options.residual_grids);
  };
  auto solution = solved(Curvature::kFitted);
  const bool is_curved = start.optics.screen_radius_m != 0;
  const bool is_held = solution && is_curved && std::ranges::any_of(solution->modules, is_warped);
  if (is_held) solution = solved(Curvature::kHeld);
  if (!solution) return solution.error().within(observations.source);

  FittedDisplay fitted{start, {}, {}, 0, is_held};
  if (is_curved && !is_held) {
    LFD_TRY_STATUS(check_radius(start.optics.screen_radius_m, 1 / solution->pinholes.curvature, observations.source));
    fitted.display.optics.screen_radius_m = 1 / solution->pinholes.curvature;
    fitted.radius_sd_m = solution->determined.curvature_sd / std::abs(solution->pinholes.curvature);
  }
  for (std::size_t k = 0; k < families.size(); ++k) {
    FittedModule& module = solution->modules[k];
    const auto outliers = judge(module, families[k], curvature_of(start), lists[k], observations.has_sigma);
    fitted.outliers.insert(fitted.outliers.end(), outliers.begin(), outliers.end());
    module.fit.held_by_start = solution->determined.held_by_start[k];
    const PinholeMap was = families[k].at(PinholeVector{}), is = families[k].at(solution->pinholes.z[k]);
    Emitter& emitter = fitted.display.modules[k].emitter;
    emitter = emitter + (is.position - was.position);
    fitted.display.modules[k].map = std::move(module.map);
    fitted.modules.push_back(std::move(module.fit));
  }
  std::ranges::sort(fitted.outliers, {}, &Outlier::line);
  if (auto status = validate(fitted.display); !status) {
    return status.error().within(observations.source + ": the fit is no valid calibration");
  }
  return fitted;
}

}  // namespace lfd
