// Emitters near the screen and far from it, at and below the observer's height, and modules of one pixel or 8192, as
// pictures.
#include "base/log.h"
#include "bench/stability/drawing.h"
#include "bench/stability/groups.h"
#include "rendernode/geometry/clip_map.h"

namespace lfd::bench {
namespace {

constexpr const char* kGroup = "pictures of modules";

// The sphere in a box that lies between the emitter and the observer.
Drawing with_display(const DisplayCalibration& display, double depth_m = 0.3) {
  RegionOfInterest roi = small_roi();
  roi.world_size.z = roi.physical_size.z = depth_m;
  return {display, sphere_in_box(roi), roi, {}};
}

DisplayCalibration with_emitter(Diffuser diffuser, Emitter emitter) {
  DisplayCalibration display = small_display(diffuser);
  display.modules[0].emitter = emitter;
  return display;
}

void add_distances(StabilityCases& cases) {
  for (const double ez : {-0.2, -1e1, -1e2, -1e4, -1e6}) {
    cases.push_back(drawn_true(kGroup, fmt::format("emitter {:g} m behind the screen", -ez), [ez] {
      return with_display(with_emitter(Diffuser::kLinear, {-0.1, -0.08, ez}));
    }));
  }
  // The region is as deep as the emitter is far away; most of it lies between two pixels.
  for (const double ez : {-1e-1, -1e-2, -1e-3, -1e-4, -1e-5, -1e-6}) {
    cases.push_back(drawn_true(kGroup, fmt::format("emitter {:g} m behind the screen", -ez), [ez] {
      return with_display(with_emitter(Diffuser::kLinear, {-0.1, -0.08, ez}), -ez);
    }));
  }
}

void add_heights(StabilityCases& cases) {
  for (const double ey : {0.05, -0.08, -1.0, -10.0, -1e3, 1e6}) {
    cases.push_back(drawn_true(kGroup, fmt::format("conical, observer at 0.05 m, emitter at height {:g} m", ey), [ey] {
      return with_display(with_emitter(Diffuser::kConical, {-0.1, ey, -0.6}));
    }));
  }
}

void add_radii(StabilityCases& cases) {
  for (const double radius : {0.2, 1.0, 1e2, 1e4, 1e6, 1e9, -0.5, -1e2, -1e4, -1e6, -1e9}) {
    cases.push_back(drawn_true(kGroup, fmt::format("screen radius {:g} m", radius), [radius] {
      DisplayCalibration display = small_display();
      display.optics.screen_radius_m = radius;
      return with_display(display, 0.2);
    }));
  }
}

void add_sizes(StabilityCases& cases) {
  const auto sized = [](ImageSize size) {
    DisplayCalibration display = small_display();
    display.image = size;
    return with_display(display);
  };
  // Near a silhouette nothing is compared; of so few pixels most are.
  const reference::TruthBounds few{1e-5, 1e-4, 1e-3, 3e-3, 0};
  cases.push_back(drawn_true(
      kGroup, "1 x 1 pixels",
      [sized] {
        return sized({1, 1});
      },
      few));
  cases.push_back(drawn_true(
      kGroup, "1 x 64 pixels",
      [sized] {
        return sized({1, 64});
      },
      few));
  cases.push_back(drawn_true(kGroup, "8192 x 4 pixels", [sized] { return sized({8192, 4}); }));
  cases.push_back(drawn_true(kGroup, "4 x 8192 pixels", [sized] { return sized({4, 8192}); }));
}

void add_homographies(StabilityCases& cases) {
  for (const double scale : {1e-100, 1e-30, 1e30, 1e100}) {
    cases.push_back(
        drawn_true(kGroup, fmt::format("a homography whose numbers are all {:g} times larger", scale), [scale] {
          DisplayCalibration display = small_display();
          display.modules[0].map = HomographyMap{scale * ideal_homography(display.screen, display.image)};
          return with_display(display);
        }));
  }
}

void add_screens(StabilityCases& cases) {
  for (const double scale : {1e-2, 1e2, 2e3}) {
    cases.push_back(drawn_true(kGroup, fmt::format("a display {:g} times as large", scale), [scale] {
      DisplayCalibration display = small_display();
      display.screen = {scale * 0.4, scale * 0.3};
      display.optics.observer_distance_m *= scale;
      display.optics.observer_height_m *= scale;
      display.modules[0].emitter = {scale * -0.1, scale * -0.08, scale * -0.6};
      Drawing drawing = with_display(display);
      drawing.roi.physical_size *= scale;
      return drawing;
    }));
  }
  cases.push_back(drawing_refused(kGroup, "a screen of a micrometre", "screen: width_m", [] {
    DisplayCalibration display = small_display();
    display.screen = {1e-6, 1e-6};
    return with_display(display);
  }));
}

}  // namespace

void add_module_cases(StabilityCases& cases) {
  add_distances(cases);
  add_heights(cases);
  add_radii(cases);
  add_sizes(cases);
  add_homographies(cases);
  add_screens(cases);
}

}  // namespace lfd::bench
