// The modules of a node as the GPU knows them: their parameters, and per-pixel tables for maps without a closed
// inverse.
#pragma once

#include <vector>

#include "calibration/display.h"
#include "rendernode/gl/objects.h"
#include "shaders/shared/glsl_types.h"

namespace lfd {

// One module's parameters; table_layer: its layer in the pixel table, or -1.
shared::ModuleParams module_params(const DisplayCalibration& display, const ModuleCalibration& module, int table_layer);

// Screen point (s, y) of every pixel centre, in metres, row by row from the top; far off the screen where there is
// none. Solved in double precision; the rows are shared among the machine's cores.
std::vector<float> pixel_table(const DisplayCalibration& display, const ModuleCalibration& module);

struct GpuModules {
  gl::Buffer params;         // array of MODULES_PER_NODE ModuleParams, one per layer
  gl::Texture pixel_tables;  // RG32F array; empty where no module needs one
  bool has_tables() const { return static_cast<bool>(pixel_tables); }
};

GpuModules upload_modules(const DisplayCalibration& display, const std::vector<std::uint32_t>& modules);

}  // namespace lfd
