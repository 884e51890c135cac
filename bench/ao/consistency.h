// Whether two neighbouring modules show the same ambient occlusion on the same surface: where they do not, a viewer who
// moves sees it shimmer.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bench/ao/metrics.h"
#include "calibration/display.h"
#include "calibration/spaces/affine.h"
#include "proto/pictures/picture.h"

namespace lfd::bench {

inline constexpr double kInconsistent = 0.02;  // a difference beyond this is counted

// A surface point at a pixel's centre in one module, and the pixels around its image in the other that show the same
// surface.
struct SharedPoint {
  std::uint32_t pixel = 0;
  std::array<std::uint32_t, 4> other{};
  std::array<float, 4> weight{};  // bilinear; 0 where another surface is shown, or none; together 1
};

// What a module shows, as it is read back: world position minus the same origin for both, alpha 1 where there is a
// surface; unit normals.
struct ShownSurfaces {
  const ModuleCalibration* module = nullptr;
  PictureF position, normal;
};

// Pixels of `one` whose surface `other` shows too: at least half of the bilinear weight is on pixels less than two
// pixels' steps away, within one of them of the tangent plane, with a normal that is alike (cosine above 0.9).
std::vector<SharedPoint> shared_points(const DisplayCalibration& display, const ShownSurfaces& one,
                                       const ShownSurfaces& other, const Affine<Physical, World>& physical_from_origin);

// Share of them whose openness differs by more than kInconsistent; 0 where there is none.
double inconsistent_share(const std::vector<SharedPoint>& points, const Openness& one, const Openness& other);

}  // namespace lfd::bench
