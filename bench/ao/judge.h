// Measurements against the reference: rows of the table, unfitted, and with curves fitted on other scenes.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/ao/ao_bench.h"
#include "bench/ao/consistency.h"
#include "bench/ao/curve_fit.h"
#include "bench/ao/measure.h"
#include "bench/ao/reference_picture.h"

namespace lfd::bench {

// Pictures of all places, by rung and radius, for fits on the scenes that a result is not of.
class Fits {
 public:
  void add(const std::string& scene, const Rung& rung, double radius_share, const JointHistogram& histogram);

  // Of pictures of this rung on all scenes but this one, at one radius or at all; absent where there is none.
  std::optional<occlusion::Curve> without(const std::string& scene, const Rung& rung,
                                          std::optional<double> radius_share = {}) const;

  // On all scenes, at all radii.
  std::optional<occlusion::Curve> over_all(const Rung& rung) const { return without("", rung); }

 private:
  static std::string key_of(const Rung& rung) { return rung.method() + ": " + rung.name; }

  // by rung, radius, scene
  std::map<std::string, std::map<double, std::map<std::string, JointHistogram>>> seen_;
};

// The curve that a rung is drawn with, unfitted.
occlusion::Curve curve_of(const Rung& rung);

// What a picture is judged against.
struct Judge {
  const Openness& cosine;
  const Openness& uniform;
  const Openness& silhouette;
  const std::vector<SharedPoint>& points;  // with the next module

  AoJudgement judge(const Measurement& seen, const occlusion::Curve& curve) const;
};

// Mean absolute difference over the pixels with a surface in all three that `mask` marks with more than a half.
double mae_where(const Openness& reference, const Openness& other, const Openness& mask);

}  // namespace lfd::bench
