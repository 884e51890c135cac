// Ambient occlusion by rays into the real geometry: what every method estimates.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "bench/reference/method_limit.h"

namespace lfd::reference {

// Of one surface for one radius: the mean over the hemisphere about its normal of W(r) = max(0, 1 - r / R), r the
// distance at which a ray hits, 0 where it hits nothing.
struct RayOcclusion {
  double cosine = 0;   // weighed by the cosine to the normal (Aalund 2013, equation 2.5)
  double uniform = 0;  // every direction alike (Pyramid HBAO, equation 1)
  // The mean of the directions, each times 1 - W(r), weighed likewise; in units of its length where all is open, so
  // that it is the normal there.
  glm::dvec3 open_cosine{0}, open_uniform{0};
};

struct RayChoice {
  int rays = 1024;  // 4 x 4 cells of directions or more
  std::uint64_t seed = 1;
};

// One answer for each radius (m, in the world), all from the same rays. They leave the surface a millionth of the ROI
// diagonal above it on the side of the normal. Errors of so many stratified rays: below 0.5 / sqrt(rays).
std::vector<RayOcclusion> ray_occlusion(const Intersector& intersector, const Spot& spot,
                                        const std::vector<double>& radius_m, const RayChoice& choice);

// The same for every pixel of a module, on all cores: rows from the top, radius by radius within a pixel; nothing where
// a pixel has no surface. The result does not depend on the number of cores.
struct RayOcclusionImage {
  ImageSize size;
  std::size_t radii = 0;
  std::vector<float> cosine, uniform;  // -1 where there is no surface

  float cosine_at(std::size_t pixel, std::size_t radius) const { return cosine[pixel * radii + radius]; }
};
RayOcclusionImage ray_occlusion_of_module(const Intersector& intersector, const ModuleView& view, const HitImage& hits,
                                          const std::vector<double>& radius_m, const RayChoice& choice);

}  // namespace lfd::reference
