// The right answer for every pixel of a module, cast once and kept in a file.
#pragma once

#include <filesystem>
#include <vector>

#include "bench/ao/metrics.h"
#include "bench/ao/place.h"

namespace lfd::bench {

// Openness by rays (bench/reference/ray_occlusion.h), radius by radius, and the pixels at silhouettes.
struct ReferencePicture {
  std::vector<double> radius_m;
  std::vector<Openness> cosine, uniform;
  Openness silhouette;  // 1 near one, 0 elsewhere
  double cast_ms = 0;   // wall clock, when they were cast
};

// All radii from the same rays. It is kept in `cache`, under a name that says what it is of, and read from there.
Result<ReferencePicture> reference_picture(const ShownScene& scene, std::uint32_t module,
                                           const reference::HitImage& hits, const std::vector<double>& radius_m,
                                           int rays, const std::filesystem::path& cache);

}  // namespace lfd::bench
