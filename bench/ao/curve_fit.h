// The post curve under which a method comes nearest to the reference.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/ao/metrics.h"
#include "proto/occlusion/method.h"

namespace lfd::bench {

// How often a method's openness (before its curve) met each openness of the reference: all that a fit has to know of
// pictures.
class JointHistogram {
 public:
  JointHistogram() : count_(std::size_t{kBins} * kBins) {}

  // Pixels with a surface in both pictures, which are of one size.
  void add(const Openness& method, const Openness& reference);
  void add(const JointHistogram& other);

  // Mean absolute error of the curve, counted from the middles of bins; 0 where there is no pixel.
  double mae(const occlusion::Curve& curve) const;
  bool empty() const { return pixels_ == 0; }

 private:
  static constexpr int kBins = 128;
  std::vector<std::uint32_t> count_;  // [method][reference]
  std::uint64_t pixels_ = 0;
};

// Openness after the curve: clamp(b (open + a), 0, 1)^c.
float curved(float open, const occlusion::Curve& curve);
Openness curved(const Openness& before, const occlusion::Curve& curve);

// Curve of the least MAE: by a pattern search from the identity and from `start` (Hooke & Jeeves 1961), within the
// limits of settings. At most as wrong as both.
occlusion::Curve fit_curve(const JointHistogram& histogram, const occlusion::Curve& start);

}  // namespace lfd::bench
