// Sample sets of the methods of ambient occlusion, made from points of a square by one of four generators.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "proto/occlusion/method.h"

namespace lfd::occlusion {

// `count` points of the square [-1, 1)^2; x2 (the second) wraps around. Deterministic in the seed, on every platform.
std::vector<glm::dvec2> square_points(const SampleChoice& choice);

// Points of the unit shell between radii `inner` and 1: direction from (x1, x2) by Algorithm 3, radius by Algorithm 4
// of Doronin et al., WSCG 2017; w unused. In pairs, points 2i and 2i + 1 mirror each other (an odd count leaves the
// last one alone).
std::vector<glm::vec4> shell_set(const SampleChoice& choice, double inner, bool pairs);

// Points of the unit disk, evenly over its area, in xy; z: 0, w: their distance from its centre. In pairs as above.
std::vector<glm::vec4> disk_set(const SampleChoice& choice, bool pairs);

// Unit vectors about +z, as likely as their cosine to it; w: a number in [0, 1) of each sample's own.
std::vector<glm::vec4> cosine_set(const SampleChoice& choice);

// Orders a set that was made of this choice so that its first k, for every k, are spread over the square: each is the
// one farthest from all before it (Gonzalez 1985). Samples in pairs stay in pairs.
void spread_prefixes(std::vector<glm::vec4>& samples, const SampleChoice& choice);

}  // namespace lfd::occlusion
