// The smoothing spline: sparse normal equations, one for each part held out.
#include "calibration/fit/residual_field.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "base/check.h"
#include "calibration/fit/pinhole_fit.h"

namespace lfd {
namespace {

constexpr std::size_t kParts = 5;
constexpr std::size_t kLeastSamples = 20;
constexpr int kTrustRounds = 6;
constexpr double kTrustWidth = 6;  // of Cauchy's loss, in robust standard deviations: corners bend most
// The width is never below this share of the residuals themselves: without noise a spline misses only what bends most,
// and must not lose its trust in that.
constexpr double kLeastWidthShare = 0.1;
constexpr double kFirstLambda = 0.01;
constexpr double kDensity = 0.7;     // intervals along an axis for each sample along it
constexpr double kFirstRung = 1e-4;  // of the ladder of lambdas, for one sample a control point
constexpr int kRungs = 10;
constexpr double kRungRatio = 5;
constexpr int kMostIntervals = 48;

using Sparse = Eigen::SparseMatrix<double>;
using Triplets = std::vector<Eigen::Triplet<double>>;
using Columns2 = Eigen::Matrix<double, Eigen::Dynamic, 2>;

// Weights of the four control points around x, in intervals from the first; and the first of the four.
struct Basis {
  int first = 0;
  std::array<double, 4> weight{};
};

Basis basis_at(double x, int intervals) {
  const double interval = std::clamp(std::floor(x), 0.0, static_cast<double>(intervals - 1));
  const double t = x - interval, r = 1 - t;
  return {static_cast<int>(interval),
          {r * r * r / 6, (3 * t * t * t - 6 * t * t + 4) / 6, (-3 * t * t * t + 3 * t * t + 3 * t + 1) / 6,
           t * t * t / 6}};
}

// Calls visit(index, weight) for the 16 control points that decide the field at p.
template <class Visit>
void for_controls(const ResidualField& field, PixelPoint p, Visit visit) {
  const Basis u = basis_at((p.x - field.first_px.x) / field.step_px.x, field.columns - 3);
  const Basis v = basis_at((p.y - field.first_px.y) / field.step_px.y, field.rows - 3);
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      visit((v.first + j) * field.columns + u.first + i,
            v.weight[static_cast<std::size_t>(j)] * u.weight[static_cast<std::size_t>(i)]);
    }
  }
}

// kDensity times as many intervals as samples along each axis, one more at each end.
ResidualField empty_field(ImageSize image, std::size_t samples) {
  const double spacing = std::sqrt(static_cast<double>(image.width) * image.height / static_cast<double>(samples));
  const auto intervals = [&](int side) {
    return std::clamp(static_cast<int>(std::lround(kDensity * side / spacing)), 3, kMostIntervals);
  };
  const int nu = intervals(image.width), nv = intervals(image.height);
  ResidualField field;
  field.columns = nu + 2 + 3;
  field.rows = nv + 2 + 3;
  field.step_px = {static_cast<double>(image.width) / nu, static_cast<double>(image.height) / nv};
  field.first_px = -field.step_px;
  field.control.resize(static_cast<std::size_t>(field.columns) * static_cast<std::size_t>(field.rows), glm::dvec2(0));
  return field;
}

// Sum of squares of third differences along columns, along rows, and (three times) along both: 0 for a field that is
// quadratic, so that borders and corners are not flattened.
Sparse roughness(const ResidualField& field) {
  constexpr std::array<std::array<double, 4>, 4> kDifferences{{{1}, {-1, 1}, {1, -2, 1}, {-1, 3, -3, 1}}};
  Triplets entries;
  int row = 0;
  const auto add = [&](int column, int line, int along_columns, int along_rows, double factor) {
    for (int j = 0; j <= along_rows; ++j) {
      for (int i = 0; i <= along_columns; ++i) {
        const double difference = kDifferences[static_cast<std::size_t>(along_columns)][static_cast<std::size_t>(i)] *
                                  kDifferences[static_cast<std::size_t>(along_rows)][static_cast<std::size_t>(j)];
        entries.emplace_back(row, (line + j) * field.columns + column + i, factor * difference);
      }
    }
    ++row;
  };
  for (int line = 0; line < field.rows; ++line) {
    for (int column = 0; column < field.columns; ++column) {
      for (int along_rows = 0; along_rows <= 3; ++along_rows) {
        const int along_columns = 3 - along_rows;
        if (column + along_columns >= field.columns || line + along_rows >= field.rows) continue;
        add(column, line, along_columns, along_rows, along_rows % 3 == 0 ? 1 : std::sqrt(3.0));
      }
    }
  }
  Sparse differences(row, field.columns * field.rows);
  differences.setFromTriplets(entries.begin(), entries.end());
  return differences.transpose() * differences;
}

// Row i: the field at sample i, by control points.
Sparse design(const ResidualField& field, std::span<const ResidualSample> samples) {
  Triplets entries;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    for_controls(field, samples[i].at,
                 [&](int control, double weight) { entries.emplace_back(static_cast<int>(i), control, weight); });
  }
  Sparse rows(static_cast<Eigen::Index>(samples.size()), static_cast<Eigen::Index>(field.control.size()));
  rows.setFromTriplets(entries.begin(), entries.end());
  return rows;
}

class Smoother {
 public:
  Smoother(ImageSize image, std::span<const ResidualSample> samples)
      : samples_(samples),
        field_(empty_field(image, samples.size())),
        roughness_(roughness(field_)),
        design_(design(field_, samples)),
        trust_(samples.size(), 1) {
    std::vector<double> distances;
    for (const ResidualSample& sample : samples) distances.push_back(glm::length(sample.residual_px) / sample.sigma_px);
    least_width_ = std::max(kLeastWidthShare * robust_spread(std::move(distances)), 1e-12);
    assemble();
  }

  // Trusts what is far off the spline of all less and less, until that settles.
  void find_trust(double lambda) {
    for (int round = 0; round < kTrustRounds; ++round) {
      const ResidualField field = solve(lambda, kParts);
      std::vector<double> distances(samples_.size());
      for (std::size_t i = 0; i < samples_.size(); ++i) distances[i] = std::sqrt(square(field, i));
      const double width = std::max(kTrustWidth * robust_spread(distances), least_width_);
      for (std::size_t i = 0; i < samples_.size(); ++i) {
        trust_[i] = 1 / (1 + distances[i] * distances[i] / (width * width));
      }
      assemble();
    }
  }

  double best_lambda() const {
    double best = 0, least = std::numeric_limits<double>::infinity();
    double lambda = kFirstRung;
    for (int rung = 0; rung < kRungs; ++rung, lambda *= kRungRatio) {
      const std::vector<double> squares = held_out_squares(lambda);
      const double sum = std::inner_product(trust_.begin(), trust_.end(), squares.begin(), 0.0);
      if (!(sum < least)) continue;
      least = sum;
      best = lambda;
    }
    return best;
  }

  SmoothedResiduals compared(double lambda) const {
    SmoothedResiduals result;
    result.field = solve(lambda, kParts);
    const std::vector<double> squares = held_out_squares(lambda);
    std::vector<double> distances;
    double all = 0, gain = 0, gain_squares = 0;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const double sigma2 = samples_[i].sigma_px * samples_[i].sigma_px;
      const double alone = glm::dot(samples_[i].residual_px, samples_[i].residual_px);
      const double by = trust_[i] * (alone / sigma2 - squares[i]);
      distances.push_back(std::sqrt(squares[i]));
      all += trust_[i];
      gain += by;
      gain_squares += by * by;
      result.held_out_without_px += trust_[i] * alone;
      result.held_out_with_px += trust_[i] * squares[i] * sigma2;
    }
    result.held_out_spread = robust_spread(std::move(distances));
    result.held_out_without_px = std::sqrt(result.held_out_without_px / all);
    result.held_out_with_px = std::sqrt(result.held_out_with_px / all);
    const double chance = std::sqrt(std::max(0.0, gain_squares - gain * gain / all));  // standard error of the sum
    result.is_better = gain > 3 * chance && result.held_out_with_px < 0.99 * result.held_out_without_px;
    return result;
  }

 private:
  // The normal equations of each part, by the samples' present weights.
  void assemble() {
    const auto controls = static_cast<Eigen::Index>(field_.control.size());
    double weights = 0;
    for (std::size_t part = 0; part < kParts; ++part) {
      Eigen::VectorXd weight = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(samples_.size()));
      Columns2 values = Columns2::Zero(static_cast<Eigen::Index>(samples_.size()), 2);
      for (std::size_t i = part; i < samples_.size(); i += kParts) {
        const auto row = static_cast<Eigen::Index>(i);
        weight[row] = trust_[i] / (samples_[i].sigma_px * samples_[i].sigma_px);
        values.row(row) << samples_[i].residual_px.x, samples_[i].residual_px.y;
      }
      normal_[part] = design_.transpose() * (weight.asDiagonal() * design_);
      right_[part] = design_.transpose() * (weight.asDiagonal() * values);
      weights += weight.sum();
    }
    unit_ = weights / static_cast<double>(controls);
  }

  // The spline of all samples but those of the part `held_out` (kParts: of all).
  ResidualField solve(double lambda, std::size_t held_out) const {
    Sparse normal = lambda * unit_ * roughness_;
    Columns2 right = Columns2::Zero(normal.rows(), 2);
    for (std::size_t part = 0; part < kParts; ++part) {
      if (part == held_out) continue;
      normal += normal_[part];
      right += right_[part];
    }
    const Eigen::SimplicialLDLT<Sparse> factors(normal);
    LFD_CHECK(factors.info() == Eigen::Success, "normal equations that are not positive");
    const Columns2 solution = factors.solve(right);
    ResidualField field = field_;
    for (Eigen::Index i = 0; i < solution.rows(); ++i) {
      field.control[static_cast<std::size_t>(i)] = {solution(i, 0), solution(i, 1)};
    }
    return field;
  }

  // Squared distances, in units of the samples' sigmas, of all samples from the spline made without their part.
  std::vector<double> held_out_squares(double lambda) const {
    std::vector<double> squares(samples_.size());
    for (std::size_t part = 0; part < kParts; ++part) {
      const ResidualField field = solve(lambda, part);
      for (std::size_t i = part; i < samples_.size(); i += kParts) squares[i] = square(field, i);
    }
    return squares;
  }

  double square(const ResidualField& field, std::size_t i) const {
    const glm::dvec2 miss = (samples_[i].residual_px - field.at(samples_[i].at)) / samples_[i].sigma_px;
    return glm::dot(miss, miss);
  }

  std::span<const ResidualSample> samples_;
  ResidualField field_;
  Sparse roughness_;
  Sparse design_;
  double least_width_ = 0;     // of Cauchy's loss, in sigmas
  std::vector<double> trust_;  // Cauchy's weights, 0 to 1
  std::array<Sparse, kParts> normal_;
  std::array<Columns2, kParts> right_;
  double unit_ = 1;  // weight of the samples for each control point
};

}  // namespace

glm::dvec2 ResidualField::at(PixelPoint p) const {
  glm::dvec2 sum(0);
  for_controls(*this, p, [&](int index, double weight) { sum += weight * control[static_cast<std::size_t>(index)]; });
  return sum;
}

std::optional<SmoothedResiduals> smooth_residuals(ImageSize image, std::span<const ResidualSample> samples) {
  if (samples.size() < kLeastSamples) return std::nullopt;
  Smoother smoother(image, samples);
  // A stiff spline would take what is bent most for outliers: trust is first found with a supple one.
  double lambda = kFirstLambda;
  for (int round = 0; round < 2; ++round) {
    smoother.find_trust(lambda);
    lambda = smoother.best_lambda();
  }
  smoother.find_trust(lambda);
  return smoother.compared(lambda);
}

}  // namespace lfd
