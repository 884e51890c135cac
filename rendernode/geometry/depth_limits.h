// The limits within which geometry is drawn, and the depth that is written for it.
#pragma once

#include "calibration/display.h"
#include "proto/settings.h"

namespace lfd {

// Depths (calibration/optics.h), metres; on planar screens they are physical z. Geometry before `front` and behind
// `back` is cut away; every module has images in between.
struct DepthLimits {
  double front = 0, back = 0;
  bool in_z = true;        // depth is z: geometry can be cut in space. On a curved screen pixels are left out instead
  double depth_scale = 1;  // clip.z = depth_scale (front - depth); less than w everywhere between the limits
  // Physical box of all that any pixel can show between the limits, with a wide margin in x and y (on a curved screen
  // in z too): what reaches beyond is cut there, for single precision does not hold the corners of very large
  // triangles.
  Point3<Physical> low, high;
  double singular = 0;  // behind `back`: the nearest place where the lines of some module meet
};

// The deployment's limits, brought inside what the optics allow: front at most 0.999 of the observer's distance and 500
// times the sum of the screen's sides, back at least 0.1 % before the nearest plane where some module on some row of
// the screen has a singularity. Defaults: settings.proto.
DepthLimits depth_limits(const DisplayCalibration& display, const RenderSettings& settings);

// The same limits in depth, the box around all that `larger` can show between them: a display with a guard band.
DepthLimits widened_to(DepthLimits limits, const DisplayCalibration& larger);

}  // namespace lfd
