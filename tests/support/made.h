// Made scenes and displays in tests, where their making cannot fail.
#pragma once

#include <string_view>

#include "calibration/display.h"
#include "calibration/spaces/roi.h"
#include "controller/scene/made/made_scenes.h"
#include "tests/support/unwrapped.h"

namespace lfd::testing_support {

// A made scene with seed 1.
inline SceneData made_data(std::string_view name) { return unwrapped(scene::make_scene(name, 1)).data; }

// The region that shows a whole scene on the display's screen.
inline RegionOfInterest whole_scene(const proto::Scene& scene, const DisplayCalibration& display) {
  const auto point = [](const proto::Vector& v) { return Point3<World>{v.x(), v.y(), v.z()}; };
  return fit_to_screen(point(scene.bounds_low()), point(scene.bounds_high()), display.screen.width_m,
                       display.screen.height_m);
}

}  // namespace lfd::testing_support
