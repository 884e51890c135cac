// Weights of the separable blur of ambient occlusion.
#pragma once

#include <vector>

namespace lfd {

// Of a Gaussian at distances 0 .. taps pixels, taps = ceil(2.5 sigma), at most 24. Not normalised: the shader divides
// by what it used.
std::vector<float> gaussian_weights(double sigma_px);

}  // namespace lfd
