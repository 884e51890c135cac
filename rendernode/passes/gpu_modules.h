// The modules of a node as the GPU knows them: their parameters, and per-pixel tables for maps without a closed
// inverse.
#pragma once

#include <vector>

#include "calibration/display.h"
#include "rendernode/geometry/warp_table.h"
#include "rendernode/gl/objects.h"
#include "rendernode/gl/program.h"
#include "rendernode/passes/gpu_colors.h"
#include "shaders/shared/glsl_types.h"

namespace lfd {

// Layers of the tables that one module reads; -1: none.
struct TableLayers {
  int pixels = -1, warp = -1;
};

// One module's parameters. `warp` is the table of a module with a GridMap, else null.
shared::ModuleParams module_params(const DisplayCalibration& display, const ModuleCalibration& module,
                                   const WarpTable* warp, TableLayers layers);

// Screen point (s, y) of every pixel centre, in metres, row by row from the top; far off the screen where there is
// none. Solved in double precision; the rows are shared among the machine's cores.
std::vector<float> pixel_table(const DisplayCalibration& display, const ModuleCalibration& module);

// What a guard band leaves of what the images without it are.
struct GuardBand {
  int px = 0;         // on every side; 0: there is none
  ScreenSize screen;  // the display's own, without the band
};

struct GpuModules {
  gl::Buffer params;         // array of MODULES_PER_NODE ModuleParams, one per layer
  gl::Texture pixel_tables;  // RG32F array: screen points of pixels; empty where no module needs one
  gl::Texture warp_tables;   // RG32F array: residuals of WarpTable; likewise
  std::optional<GpuColors> colors;
  int guard_band_px = 0;
  gl::Flags map_flags;  // of shaders that map points: what no module has (lib/optics.glsl, lib/image_map.glsl)
  bool has_tables() const { return static_cast<bool>(pixel_tables); }
};

// display: with the guard band.
GpuModules upload_modules(const DisplayCalibration& display, const std::vector<std::uint32_t>& modules,
                          const WarpTables& tables, GuardBand band);

}  // namespace lfd
