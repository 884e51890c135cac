// The optimisation through Ceres, at scales that follow the residuals down.
#include "calibration/fit/pinhole_fit.h"

#include <ceres/autodiff_cost_function.h>
#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/log.h"

namespace lfd {
namespace {

constexpr int kMostRounds = 25;
constexpr double kScaleSettled = 1e-3;  // relative change below which scales stay

struct ObservationCost {
  const PinholeFamily* family;
  const Observation* seen;
  const double* scale;
  double start_curvature;

  template <class T>
  bool operator()(const T* z, const T* curvature_change, T* residual) const {
    using std::exp;
    const T curvature = start_curvature * exp(kCurvatureSd * curvature_change[0]);
    T uv[2];
    if (!family->project(z, curvature, T(seen->on_screen.x), T(seen->on_screen.y), uv)) return false;
    const double sigma = *scale * seen->sigma_px;
    residual[0] = (uv[0] - seen->in_image.x) / sigma;
    residual[1] = (uv[1] - seen->in_image.y) / sigma;
    return true;
  }
};

template <int kCount>
struct Prior {
  template <class T>
  bool operator()(const T* z, T* residual) const {
    std::copy_n(z, kCount, residual);
    return true;
  }
};

class Optimisation {
 public:
  Optimisation(std::span<const PinholeFamily> families, std::span<const ModuleObservations> modules,
               double start_curvature, Curvature curvature, bool sigmas_are_known)
      : families_(families),
        modules_(modules),
        start_curvature_(start_curvature),
        least_scale_(sigmas_are_known ? 1 : kLeastScale_px),
        problem_(problem_options()) {
    fit_.z.resize(families.size(), PinholeVector{});
    fit_.scale.resize(families.size(), 1);
    for (std::size_t k = 0; k < families.size(); ++k) add_module(k);
    if (start_curvature == 0 || curvature == Curvature::kHeld) {
      problem_.SetParameterBlockConstant(&fit_.curvature_change);
    } else {
      problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<Prior<1>, 1, 1>(new Prior<1>), nullptr,
                                &fit_.curvature_change);
    }
  }

  Result<PinholeFit> run() {
    LFD_TRY_STATUS(update_scales());
    for (int round = 0; round < kMostRounds; ++round) {
      const std::vector<double> before = fit_.scale;
      LFD_TRY_STATUS(solve());
      LFD_TRY_STATUS(update_scales());
      const bool settled = std::ranges::equal(before, fit_.scale,
                                              [](double a, double b) { return std::abs(a - b) <= kScaleSettled * a; });
      if (settled) return fit_;
    }
    return fit_;  // scales move a little to and fro: as good as settled
  }

 private:
  static ceres::Problem::Options problem_options() {
    ceres::Problem::Options options;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }

  void add_module(std::size_t k) {
    for (const Observation& seen : modules_[k]) {
      auto* const cost = new ceres::AutoDiffCostFunction<ObservationCost, 2, kPinholeParameters, 1>(
          new ObservationCost{&families_[k], &seen, &fit_.scale[k], start_curvature_});
      problem_.AddResidualBlock(cost, &loss_, fit_.z[k].data(), &fit_.curvature_change);
    }
    problem_.AddResidualBlock(
        new ceres::AutoDiffCostFunction<Prior<kPinholeParameters>, kPinholeParameters, kPinholeParameters>(
            new Prior<kPinholeParameters>),
        nullptr, fit_.z[k].data());
  }

  Status update_scales() {
    fit_.curvature = start_curvature_ * std::exp(kCurvatureSd * fit_.curvature_change);
    for (std::size_t k = 0; k < families_.size(); ++k) {
      std::vector<double> distances;
      for (const Observation& seen : modules_[k]) {
        const auto residual = pinhole_residual(families_[k], fit_.z[k], fit_.curvature, seen);
        if (!residual) {
          return Error(fmt::format("module {}: the point of line {} lies behind the start's projector", k, seen.line));
        }
        distances.push_back(glm::length(*residual) / seen.sigma_px);
      }
      fit_.scale[k] = std::max(least_scale_, robust_spread(std::move(distances)));
    }
    return {};
  }

  Status solve() {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    options.num_threads = 1;  // sums in one order: equal input, equal output
    options.max_num_iterations = 100;
    options.function_tolerance = 1e-10;
    options.gradient_tolerance = 1e-12;
    options.parameter_tolerance = 1e-12;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    if (!summary.IsSolutionUsable()) return Error("the optimisation failed: " + summary.message);
    return {};
  }

  std::span<const PinholeFamily> families_;
  std::span<const ModuleObservations> modules_;
  double start_curvature_;
  double least_scale_;
  PinholeFit fit_;
  ceres::CauchyLoss loss_{kLossWidth};
  ceres::Problem problem_;
};

}  // namespace

Result<PinholeFit> fit_pinholes(std::span<const PinholeFamily> families, std::span<const ModuleObservations> modules,
                                double start_curvature, Curvature curvature, bool sigmas_are_known) {
  LFD_CHECK(families.size() == modules.size(), "a family and observations for each module");
  return Optimisation(families, modules, start_curvature, curvature, sigmas_are_known).run();
}

std::optional<glm::dvec2> pinhole_residual(const PinholeFamily& family, const PinholeVector& z, double curvature,
                                           const Observation& observation) {
  double uv[2];
  if (!family.project(z.data(), curvature, observation.on_screen.x, observation.on_screen.y, uv)) return std::nullopt;
  return glm::dvec2(uv[0] - observation.in_image.x, uv[1] - observation.in_image.y);
}

double robust_spread(std::vector<double> distances) {
  LFD_CHECK(!distances.empty(), "a spread of nothing");
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::ranges::nth_element(distances, middle);
  return *middle / std::sqrt(2 * std::log(2.0));  // the median of Rayleigh's distribution
}

}  // namespace lfd
