// Weights of the Gaussian.
#include "rendernode/passes/blur_weights.h"

#include <algorithm>
#include <cmath>

namespace lfd {

int gaussian_taps(double sigma_px) { return std::min(24, static_cast<int>(std::ceil(2.5 * sigma_px))); }

std::vector<float> gaussian_weights(double sigma_px) {
  const int taps = gaussian_taps(sigma_px);
  std::vector<float> weights;
  for (int i = 0; i <= taps; ++i) weights.push_back(static_cast<float>(std::exp(-0.5 * i * i / (sigma_px * sigma_px))));
  return weights;
}

}  // namespace lfd
