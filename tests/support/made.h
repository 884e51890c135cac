// Made scenes and displays in tests, where their making cannot fail.
#pragma once

#include <utility>

#include "base/check.h"
#include "base/result.h"
#include "calibration/display.h"
#include "calibration/spaces/roi.h"
#include "controller/scene/made/made_scenes.h"

namespace lfd::testing_support {

// The value, or the end of the process with the error's message.
template <class T>
T unwrapped(Result<T> result) {
  LFD_CHECK(result, result.error().message());
  return *std::move(result);
}

// A made scene with seed 1.
inline SceneData made_data(std::string_view name) { return unwrapped(scene::make_scene(name, 1)).data; }

// The region that shows a whole scene on the display's screen.
inline RegionOfInterest whole_scene(const proto::Scene& scene, const DisplayCalibration& display) {
  const auto point = [](const proto::Vector& v) { return Point3<World>{v.x(), v.y(), v.z()}; };
  return fit_to_screen(point(scene.bounds_low()), point(scene.bounds_high()), display.screen.width_m,
                       display.screen.height_m);
}

}  // namespace lfd::testing_support
