// The colour calibrations of a node's modules as the GPU knows them.
#pragma once

#include <optional>
#include <vector>

#include "calibration/display.h"
#include "rendernode/gl/objects.h"
#include "shaders/shared/glsl_types.h"

namespace lfd {

// One module's parameters; its samples, gains first, are appended to `samples`.
shared::ColorParams color_params(const ColorCalibration& color, std::vector<float>& samples);

struct GpuColors {
  gl::Buffer params;   // array of MODULES_PER_NODE ColorParams, one per layer
  gl::Buffer samples;  // gains and tables of all modules
};

// Absent where none of the modules has a colour calibration.
std::optional<GpuColors> upload_colors(const DisplayCalibration& display, const std::vector<std::uint32_t>& modules);

}  // namespace lfd
