// Weights of the separable blur of ambient occlusion.
#pragma once

#include <vector>

namespace lfd {

// How far a Gaussian looks to each side: ceil(2.5 sigma) pixels, at most 24.
int gaussian_taps(double sigma_px);

// Of a Gaussian at distances 0 .. gaussian_taps() pixels. Not normalised: the shader divides
// by what it used.
std::vector<float> gaussian_weights(double sigma_px);

}  // namespace lfd
