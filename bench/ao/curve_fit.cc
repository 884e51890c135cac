// Histograms, and the pattern search over them.
#include "bench/ao/curve_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.h"

namespace lfd::bench {
namespace {

constexpr std::array<double, 3> kLeast{-1, 1e-3, 1e-3}, kMost{1, 1e3, 1e3};  // as proto/settings.cc has them

using Point = std::array<double, 3>;

occlusion::Curve curve_of(const Point& p) { return {p[0], p[1], p[2]}; }

// a is moved by a step, b and c by a factor.
Point moved(Point at, const Point& steps) {
  at[0] += steps[0];
  for (std::size_t axis = 1; axis < 3; ++axis) at[axis] *= std::exp(steps[axis]);
  for (std::size_t axis = 0; axis < 3; ++axis) at[axis] = std::clamp(at[axis], kLeast[axis], kMost[axis]);
  return at;
}

// Hooke & Jeeves 1961: steps along each axis in turn, then as far again along what they made together; shorter steps
// where none helps.
Point search(const JointHistogram& histogram, Point at) {
  double best = histogram.mae(curve_of(at));
  const auto is_better = [&](const Point& next) {
    const double error = histogram.mae(curve_of(next));
    if (error >= best) return false;
    best = error;
    at = next;
    return true;
  };
  for (double step = 0.2; step > 1e-3; step /= 2) {
    for (int round = 0; round < 100; ++round) {
      Point made{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const double sign : {1.0, -1.0}) {
          Point one{};
          one[axis] = sign * step;
          if (!is_better(moved(at, one))) continue;
          made[axis] = one[axis];
          break;
        }
      }
      if (made == Point{}) break;
      while (is_better(moved(at, made))) {
      }
    }
  }
  return at;
}

}  // namespace

void JointHistogram::add(const Openness& method, const Openness& reference) {
  LFD_CHECK(method.size == reference.size, "pictures of one size are compared");
  const auto bin = [](float open) { return std::clamp(static_cast<int>(open * kBins), 0, kBins - 1); };
  for (std::size_t i = 0; i < method.value.size(); ++i) {
    if (method.value[i] < 0 || reference.value[i] < 0) continue;
    ++count_[static_cast<std::size_t>(bin(method.value[i])) * kBins + bin(reference.value[i])];
    ++pixels_;
  }
}

void JointHistogram::add(const JointHistogram& other) {
  for (std::size_t i = 0; i < count_.size(); ++i) count_[i] += other.count_[i];
  pixels_ += other.pixels_;
}

double JointHistogram::mae(const occlusion::Curve& curve) const {
  if (pixels_ == 0) return 0;
  const auto middle = [](int bin) { return (static_cast<float>(bin) + 0.5F) / kBins; };
  double sum = 0;
  for (int i = 0; i < kBins; ++i) {
    const float open = curved(middle(i), curve);
    for (int j = 0; j < kBins; ++j) sum += count_[static_cast<std::size_t>(i) * kBins + j] * std::abs(open - middle(j));
  }
  return sum / static_cast<double>(pixels_);
}

float curved(float open, const occlusion::Curve& curve) {
  return static_cast<float>(std::pow(std::clamp(curve.b * (open + curve.a), 0.0, 1.0), curve.c));
}

Openness curved(const Openness& before, const occlusion::Curve& curve) {
  Openness after = before;
  for (float& open : after.value) {
    if (open >= 0) open = curved(open, curve);
  }
  return after;
}

occlusion::Curve fit_curve(const JointHistogram& histogram, const occlusion::Curve& start) {
  Point best{0, 1, 1};
  for (const Point& from :
       {Point{0, 1, 1}, Point{start.a, start.b, start.c}, Point{0, 1, 3}, Point{0.3, 1, 3}, Point{-0.2, 1, 1}}) {
    const Point found = search(histogram, from);
    if (histogram.mae(curve_of(found)) < histogram.mae(curve_of(best))) best = found;
  }
  return curve_of(best);
}

}  // namespace lfd::bench
