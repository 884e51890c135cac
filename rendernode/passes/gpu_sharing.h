// What shaders are told of modules that share their ambient occlusion: neighbours, parts of the samples, noise that
// sticks to surfaces.
#pragma once

#include <vector>

#include "calibration/display.h"
#include "calibration/spaces/roi.h"
#include "proto/settings.h"
#include "rendernode/plan/sharing.h"
#include "shaders/shared/glsl_types.h"

namespace lfd {

// The samples of all parts, part by part, of `ao.samples` each: together one set of the method's generator, so that
// neighbours complete each other. Fewer parts than `parts` where the shaders' table is too short. Samples 2i and 2i + 1
// of the set stay together: they may be a pair.
std::vector<glm::vec4> dealt_samples(const AoSettings& ao, int parts);

// MODULES_PER_NODE entries. Modules differ by their samples or, where the method has no set of them, by what is added
// to their noise: the points of a lattice, evenly spread in each of the three numbers over the parts.
std::vector<shared::SharingParams> sharing_params(const Sharing& sharing, const AoSettings& ao);

// AoParams::noise. Noise is counted from the origin of the world, so that a surface keeps it wherever the region of
// interest goes.
glm::vec4 noise_origin(const RegionOfInterest& roi, const DisplayCalibration& display);

}  // namespace lfd
