// Pictures at the ends of the limits that calibration/limits.h states.
#include <algorithm>
#include <functional>

#include "base/log.h"
#include "bench/reference/scene_maker.h"
#include "bench/stability/drawing.h"
#include "bench/stability/groups.h"
#include "calibration/limits.h"
#include "calibration/make.h"

namespace lfd::bench {
namespace {

constexpr const char* kGroup = "pictures at the ends of the limits";

// The sphere in a box of this depth, on a display so many times larger than small_display() but for what `change` does.
Drawing at_end(double scale, double depth_m, const std::function<void(DisplayCalibration&)>& change) {
  DisplayCalibration display = small_display();
  display.screen = {scale * display.screen.width_m, scale * display.screen.height_m};
  display.optics.observer_distance_m *= scale;
  display.optics.observer_height_m *= scale;
  for (double Emitter::*part : {&Emitter::x, &Emitter::y, &Emitter::z}) display.modules[0].emitter.*part *= scale;
  RegionOfInterest roi = small_roi();
  roi.physical_size *= scale;
  change(display);
  roi.world_size.z = depth_m;
  roi.physical_size.z = scale * depth_m;
  return {display, sphere_in_box(roi), roi, {}};
}

StabilityCase end(const std::string& name, double scale, double depth_m,
                  std::function<void(DisplayCalibration&)> change) {
  return drawn_true(kGroup, name, [=] { return at_end(scale, depth_m, change); });
}

// A lens of this focal length whose picture fills the screen: as far behind it as that needs.
StabilityCase focal_length(double focal_px) {
  const double distance_m = focal_px * 0.4 / 128;
  return end(fmt::format("focal length {:g} px", focal_px), 1, std::min(0.3, distance_m),
             [distance_m](DisplayCalibration& display) {
               display.modules[0].emitter = {0, 0, -distance_m};
               display.modules[0].map = pinhole_of_ideal(display.screen, display.image, display.modules[0].emitter);
             });
}

// A wall, and on its left half another, 1.5 mm before it.
StabilityCase step_before_wall(const std::string& name, std::function<void(DisplayCalibration&)> change) {
  return drawn_true(kGroup, name, [=] {
    Drawing drawing = at_end(1, 0.3, change);
    reference::SceneMaker maker;
    const auto plain = maker.add_material({});
    maker.add_quad({-0.5F, -0.5F, -0.1F}, {0.5F, -0.5F, -0.1F}, {0.5F, 0.5F, -0.1F}, {-0.5F, 0.5F, -0.1F}, plain);
    maker.add_quad({-0.5F, -0.5F, -0.0985F}, {0, -0.5F, -0.0985F}, {0, 0.5F, -0.0985F}, {-0.5F, 0.5F, -0.0985F}, plain);
    drawing.data = maker.data();
    return drawing;
  });
}

}  // namespace

void add_end_cases(StabilityCases& cases) {
  const auto nothing = [](DisplayCalibration&) {};
  const Limits side = kScreenSide_m, distance = kObserverDistance_m, place = kPlace_m, focal = kFocalLength_px;
  // The shorter side is 0.3 m at scale 1, the longer 0.4 m; the observers stand 0.8 m away.
  cases.push_back(end(fmt::format("screen sides from {:g} m", side.least), side.least / 0.2999999, 0.3, nothing));
  cases.push_back(end(fmt::format("screen sides to {:g} m", side.most), side.most / 0.4000001, 0.3, nothing));
  cases.push_back(end(fmt::format("observers at {:g} m", distance.least), 4e-3, 0.3, [=](DisplayCalibration& display) {
    display.optics.observer_distance_m = distance.least;
    display.optics.observer_height_m = 0;
  }));
  cases.push_back(end(fmt::format("observers at {:g} m", distance.most), 1, 0.3,
                      [=](DisplayCalibration& display) { display.optics.observer_distance_m = distance.most; }));
  cases.push_back(
      step_before_wall(fmt::format("observers at {:g} m, a step of 1.5 mm", distance.most),
                       [=](DisplayCalibration& display) { display.optics.observer_distance_m = distance.most; }));
  cases.push_back(step_before_wall(fmt::format("an emitter at {:g} m, a step of 1.5 mm", kEmitterDistance_m.most),
                                   [=](DisplayCalibration& display) {
                                     display.modules[0].emitter = {0, 0, -kEmitterDistance_m.most};
                                   }));
  cases.push_back(end(fmt::format("observers at the height {:g} m, as far away", place.most), 1, 0.3,
                      [=](DisplayCalibration& display) {
                        display.optics.observer_height_m = place.most;
                        display.optics.observer_distance_m = distance.most;
                      }));
  const auto conical_height = [](double height_m) {
    return [height_m](DisplayCalibration& display) {
      display.optics.diffuser = Diffuser::kConical;
      display.optics.observer_height_m = height_m;
    };
  };
  cases.push_back(end(fmt::format("conical: observers {:g} times as high as far away", kMostConicalHeight), 1, 0.3,
                      conical_height(0.8 * kMostConicalHeight)));
  cases.push_back(drawing_refused(kGroup, "conical: observers 1000 times as high as far away", "observer_height_m",
                                  [=] { return at_end(1, 0.3, conical_height(800)); }));
  cases.push_back(end(fmt::format("an emitter {:g} m to the side, as far away", place.most), 1, 0.3,
                      [=](DisplayCalibration& display) {
                        display.modules[0].emitter = {place.most, place.most, -kEmitterDistance_m.most};
                      }));
  for (const double focal_px : {focal.least, 1.0, 1e3, focal.most}) cases.push_back(focal_length(focal_px));
}

}  // namespace lfd::bench
