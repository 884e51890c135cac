// Information matrices at the solution, in units of the prior.
#include "calibration/fit/determined.h"

#include <ceres/jet.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

#include "base/log.h"

namespace lfd {
namespace {

constexpr int kAll = kPinholeParameters + 1;  // the last: the logarithm of the screen's curvature
constexpr int kOfAHomography = 8;
using Matrix = Eigen::Matrix<double, kAll, kAll>;
using PinholeMatrix = Eigen::Matrix<double, kPinholeParameters, kPinholeParameters>;
using Jet = ceres::Jet<double, kAll>;

// Of the observations alone, each weighed as Cauchy's loss did.
Matrix information(const PinholeFamily& family, const ModuleObservations& points, double start_curvature,
                   const PinholeVector& z, double scale, double curvature_change) {
  std::array<Jet, kPinholeParameters> parameters;
  for (int i = 0; i < kPinholeParameters; ++i) {
    parameters[static_cast<std::size_t>(i)] = Jet(z[static_cast<std::size_t>(i)], i);
  }
  const Jet curvature = start_curvature * exp(kCurvatureSd * Jet(curvature_change, kPinholeParameters));
  Matrix sum = Matrix::Zero();
  for (const Observation& seen : points) {
    Jet uv[2];
    if (!family.project(parameters.data(), curvature, Jet(seen.on_screen.x), Jet(seen.on_screen.y), uv)) continue;
    const double sigma = scale * seen.sigma_px;
    const double distance = std::hypot(uv[0].a - seen.in_image.x, uv[1].a - seen.in_image.y) / (kLossWidth * sigma);
    const double weight = 1 / (sigma * sigma * (1 + distance * distance));
    for (const Jet& along : uv) sum += weight * along.v * along.v.transpose();
  }
  return sum;
}

Status check_picture(const PinholeMatrix& observed) {
  const Eigen::SelfAdjointEigenSolver<PinholeMatrix> directions(observed);
  const int needed = kPinholeParameters - kOfAHomography;  // eigenvalues ascend
  if (directions.eigenvalues()[needed] > 1) return {};
  const int known = static_cast<int>((directions.eigenvalues().array() > 1).count());
  int parameter = 0;
  directions.eigenvectors().col(needed).cwiseAbs().maxCoeff(&parameter);
  return Error(
      fmt::format("under-determined: of the {} combinations of parameters that place its picture, the "
                  "observations know {} better than the start does; undetermined: {}",
                  kOfAHomography, known, kPinholeParameterNames[static_cast<std::size_t>(parameter)]));
}

}  // namespace

Result<Determined> determined_by(std::span<const PinholeFamily> families, std::span<const ModuleObservations> modules,
                                 double start_curvature, const PinholeFit& fit) {
  Determined determined;
  double curvature_information = 1;  // the prior's
  for (std::size_t k = 0; k < families.size(); ++k) {
    const Matrix all =
        information(families[k], modules[k], start_curvature, fit.z[k], fit.scale[k], fit.curvature_change);
    const PinholeMatrix observed = all.topLeftCorner<kPinholeParameters, kPinholeParameters>();
    if (auto status = check_picture(observed); !status) return status.error().within(fmt::format("module {}", k));
    const Eigen::LDLT<PinholeMatrix> with_prior(observed + PinholeMatrix::Identity());
    const PinholeMatrix covariance = with_prior.solve(PinholeMatrix::Identity());
    auto& held = determined.held_by_start.emplace_back();
    for (int i = 0; i < kPinholeParameters; ++i) {
      if (covariance(i, i) > 0.5) held.emplace_back(kPinholeParameterNames[static_cast<std::size_t>(i)]);
    }
    const auto coupling = all.topRightCorner<kPinholeParameters, 1>();
    curvature_information += all(kPinholeParameters, kPinholeParameters) - coupling.dot(with_prior.solve(coupling));
  }
  if (start_curvature != 0) determined.curvature_sd = kCurvatureSd / std::sqrt(std::max(1.0, curvature_information));
  return determined;
}

}  // namespace lfd
