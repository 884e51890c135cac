// What each method of ambient occlusion converges to at a point: its definition in double precision, over the surfaces
// that the module's own lines meet, without pixels and with as many samples as wanted.
#pragma once

#include <cstdint>

#include "bench/reference/caster.h"
#include "proto/settings.h"

namespace lfd::reference {

struct LimitEffort {
  int samples = 20000;  // of methods that sample
  int directions = 64;  // of methods that look along directions, to both sides together
  int steps = 400;      // along each
  std::uint64_t seed = 1;
};

// A surface as its pixel shows it.
struct Spot {
  Point3<World> p;
  Vector3<World> normal;  // unit, on the side that is seen
};

// Of what a pixel's line has hit.
Spot spot_of(const ModuleView& view, const WorldScene& scene, const Hit& hit);

// Before the post curve, 0 to 1, for one radius (world). Samples, directions and steps are those of the effort, every
// other parameter the settings'. Differences to what is drawn: pixels, the half floats of normals, and that steps of a
// horizon search are infinitely many here.
double method_limit(const Intersector& intersector, const ModuleView& view, const Spot& spot,
                    const AoSettings& settings, double radius_m, const LimitEffort& effort);

// After the largest of settings.radii radii has won (R, R/2, ...), and after the post curve.
double curved_limit(const Intersector& intersector, const ModuleView& view, const Spot& spot,
                    const AoSettings& settings, const LimitEffort& effort);

}  // namespace lfd::reference
