// The modules of a node as frames draw them: their images, with a guard band or without, and their maps on the GPU.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "rendernode/passes/gpu_modules.h"

namespace lfd {

struct DrawnModules {
  DisplayCalibration display;  // with the guard band, if there is one
  WarpTables tables;
  std::vector<std::string> warnings;  // of the tables
  GpuModules gpu;
};

// modules: numbers, of the layers. guard_band_px: even, 0: none. warp_level: as of warp_tables(). On the heap, since
// others refer to display and tables. Errors: a band that is too large, tables that cannot stand for their maps,
// memory.
Result<std::unique_ptr<const DrawnModules>> draw_modules(const DisplayCalibration& display,
                                                         const std::vector<std::uint32_t>& modules, int warp_level,
                                                         int guard_band_px);

}  // namespace lfd
