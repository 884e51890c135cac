// How time and error grow with the radius, with the resolution, and with the number of modules that share.
#pragma once

#include <vector>

#include "bench/ao/ao_bench.h"
#include "bench/ao/measure.h"
#include "bench/ao/reference_picture.h"

namespace lfd::bench {

// Shares of the ROI diagonal, each twice the one before.
const std::vector<double>& scaling_radii();

struct ScalingInputs {
  const gl::Context& context;
  const AoBenchOptions& options;
  const ShownScene& scene;
  std::uint32_t module;
  const std::vector<Rung>& rungs;  // of which those are taken that are a method's default
};

// The reference has the scaling_radii().
Result<std::vector<ScalingRow>> scale_radius(const ScalingInputs& inputs, const ReferencePicture& reference);

// Errors are of pixels chosen at random.
Result<std::vector<ScalingRow>> scale_size(const ScalingInputs& inputs, double radius_share);

// `march`, 4 directions and 4 steps, over +-4 neighbours.
Result<std::vector<SharingRow>> scale_modules(const ScalingInputs& inputs, double radius_share);

}  // namespace lfd::bench
