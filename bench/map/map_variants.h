// The ways of drawing through a calibrated map that are compared: where vertices stand, and what a pixel's position is.
#pragma once

#include <string>
#include <vector>

#include "calibration/display.h"
#include "proto/settings.pb.h"

namespace lfd::bench {

struct MapVariant {
  std::string name;
  proto::RenderSettings render;  // what differs from the deployment's: subdivision, position, tessellation, table
};

// Plain vertices first. Sizes of the warp table are among them only for displays that have measured maps.
std::vector<MapVariant> map_variants(const DisplayCalibration& display);

}  // namespace lfd::bench
