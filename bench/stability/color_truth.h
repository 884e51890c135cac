// Whether the colours of a drawn module are those that its other buffers and the lights make.
#pragma once

#include <string>

#include "calibration/display.h"
#include "proto/settings.h"
#include "rendernode/renderer.h"

namespace lfd::bench {

struct ColorTruth {
  std::size_t compared = 0;  // pixels, those without a surface too
  std::size_t surfaces = 0;  // of those: with a surface
  int worst = 0;             // largest difference of a byte from what the equations of calibration/color.h make
  std::string where;         // pixel and bytes of it
};

// In double, on the CPU: the base colour of the scene's only material, ambient and head lights, the drawn normals and
// ambient occlusion, then the module's colour calibration or sRGB. `frame` has COLOR, POSITION, NORMAL and AO of module
// 0 of the display.
ColorTruth compare_colors(const DisplayCalibration& display, const proto::Scene& scene, const RegionOfInterest& roi,
                          const RenderSettings& settings, const FrameResult& frame);

// Bytes: the target and the albedo are each rounded to one, normals to half precision.
inline constexpr int kColorTolerance = 2;

}  // namespace lfd::bench
