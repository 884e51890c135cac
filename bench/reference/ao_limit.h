// What ambient occlusion by sphere samples converges to at a point: the share of the shell that is hidden, by casting.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/reference/caster.h"
#include "proto/settings.h"

namespace lfd::reference {

struct AoSampling {
  double radius_m = 0;  // of the largest shell, in the world; shell i has radius_m / 2^i
  int samples = 100000;
  std::uint64_t seed = 1;
};

struct AoLimit {
  std::vector<double> hidden_share;  // of each shell, largest radius first; standard error sqrt(h (1 - h) / samples)
  double ao = 0;                     // the largest of them
  double curved = 0;                 // after the post curve
};

// ao' = 1 - clamp(b ((1 - ao) + a), 0, 1)^c with a, b, c of the settings.
double post_curve(double ao, const AoSettings& settings);

// At the world point p of a surface: samples uniform in the shells between the parameter `shell` R and R around it
// (directions by Algorithm 3 and radii by Algorithm 4 of Doronin et al., WSCG 2017; all settings.radii shells share
// directions and relative radii). A sample is hidden if on its own pixel line a surface has a larger physical z;
// samples without an image, or without a surface on their line, are open. Neither pixels nor the settings' own
// generator, sample count and seed come into it.
AoLimit ao_limit(const Intersector& intersector, const ModuleView& view, Point3<World> p, const AoSettings& settings,
                 const AoSampling& sampling);

}  // namespace lfd::reference
