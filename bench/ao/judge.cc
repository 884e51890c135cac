// Errors of pictures.
#include "bench/ao/judge.h"

#include <cmath>

namespace lfd::bench {
void Fits::add(const std::string& scene, const Rung& rung, double radius_share, const JointHistogram& histogram) {
  seen_[key_of(rung)][radius_share][scene].add(histogram);
}

std::optional<occlusion::Curve> Fits::without(const std::string& scene, const Rung& rung,
                                              std::optional<double> radius_share) const {
  const auto of_rung = seen_.find(key_of(rung));
  if (of_rung == seen_.end()) return std::nullopt;
  JointHistogram others;
  for (const auto& [radius, scenes] : of_rung->second) {
    if (radius_share && radius != *radius_share) continue;
    for (const auto& [name, histogram] : scenes) {
      if (name != scene) others.add(histogram);
    }
  }
  if (others.empty()) return std::nullopt;
  return fit_curve(others, curve_of(rung));
}

occlusion::Curve curve_of(const Rung& rung) {
  if (!rung.settings.has_curve()) return occlusion::find_method(rung.method())->curve;
  const auto& curve = rung.settings.curve();
  return {curve.a(), curve.b(), curve.c()};
}

AoJudgement Judge::judge(const Measurement& seen, const occlusion::Curve& curve) const {
  const Openness open = curved(seen.open, curve);
  const AoDifference off = difference(cosine, open);
  AoJudgement found{off.mae, off.ssim, off.mean, difference(uniform, open).mae, mae_where(cosine, open, silhouette), 0};
  if (!seen.beside.value.empty()) found.inconsistent = inconsistent_share(points, open, curved(seen.beside, curve));
  return found;
}

double mae_where(const Openness& reference, const Openness& other, const Openness& mask) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < reference.value.size(); ++i) {
    if (reference.value[i] < 0 || other.value[i] < 0 || !(mask.value[i] > 0.5F)) continue;
    sum += std::abs(double{other.value[i]} - reference.value[i]);
    ++count;
  }
  return count == 0 ? 0 : sum / static_cast<double>(count);
}

}  // namespace lfd::bench
