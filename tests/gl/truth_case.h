// One case of the truth test: a scene on a display, rendered, and held against its pixels' own lines.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/map/map_bench.h"
#include "calibration/display.h"
#include "calibration/spaces/roi.h"
#include "proto/scene_data.h"

namespace lfd::testing_support {

struct TruthCase {
  std::string name;  // as it is printed; also names the picture of a failure
  SceneData data;
  DisplayCalibration display;
  std::vector<std::uint32_t> modules;
  RegionOfInterest roi;
  bench::MapBounds way = {};  // bounds of the way of drawing, beside those of the truth
};

// Renders the modules in one frame, compares their positions with the reference, prints the figures, and fails the test
// where a bound of reference::TruthBounds is broken. Then a picture of the differences is written beside the programs:
//   red: a surface only in the reference; blue: only in what was rendered; dark grey: near a silhouette, not compared;
//   green to white: an error of 1e-7 and less to 1e-3 and more of the ROI diagonal, by its logarithm.
void expect_true(const TruthCase& test_case);

}  // namespace lfd::testing_support
