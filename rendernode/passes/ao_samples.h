// Sample sets of the sphere method: points in a spherical shell (Doronin et al., WSCG 2017, Algorithms 3 and 4).
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "proto/settings.h"

namespace lfd {

// `count` points of the square [-1, 1)^2; x2 (the second) wraps around. Deterministic in the seed, on every platform.
std::vector<glm::dvec2> square_points(SampleGenerator generator, int count, std::uint32_t seed);

// Points of the unit shell between radii `shell` and 1: direction from (x1, x2) by Algorithm 3, radius by Algorithm 4;
// w unused. With point_symmetric set, points 2i and 2i + 1 mirror each other (an odd count leaves the last one alone).
std::vector<glm::vec4> shell_samples(const AoSettings& settings);

// Weights of a Gaussian at distances 0 .. taps pixels, taps = ceil(2.5 sigma), at most 24. Not normalised: the shader
// divides by what it used.
std::vector<float> gaussian_weights(double sigma_px);

}  // namespace lfd
