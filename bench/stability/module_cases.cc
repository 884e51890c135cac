// Emitters near the screen and far from it, at and below the observer's height, and modules of one pixel or 8192, as
// pictures.
#include <algorithm>
#include <cmath>

#include "base/log.h"
#include "bench/stability/drawing.h"
#include "bench/stability/groups.h"
#include "calibration/check/acceptance.h"
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

// Screen, observers, emitter and what they show, so many times larger.
Drawing scaled(DisplayCalibration display, double scale, double depth_m = 0.3) {
  display.screen = {scale * display.screen.width_m, scale * display.screen.height_m};
  display.optics.observer_distance_m *= scale;
  display.optics.observer_height_m *= scale;
  display.optics.screen_radius_m *= scale;
  for (double Emitter::*part : {&Emitter::x, &Emitter::y, &Emitter::z}) display.modules[0].emitter.*part *= scale;
  Drawing drawing = with_display(display, depth_m);
  drawing.roi.physical_size *= scale;
  return drawing;
}

DisplayCalibration bent(double radius_m, bool observer_arc) {
  DisplayCalibration display = small_display();
  display.optics.screen_radius_m = radius_m;
  display.optics.observer_arc = observer_arc;
  return display;
}

// On a cylinder and with a conical diffuser the emitter's distance enters otherwise than above.
void add_distances_of_other_optics(StabilityCases& cases) {
  for (const double ez : {-1e-6, -1e-2, -0.2, -1e1, -1e2, -1e3, -1e4, -1e6}) {
    cases.push_back(drawn_true(kGroup, fmt::format("conical, emitter {:g} m behind the screen", -ez), [ez] {
      return with_display(with_emitter(Diffuser::kConical, {-0.1, -0.08, ez}), std::min(0.2, -ez));
    }));
  }
  const auto on_cylinder = [](double radius, bool arc, double ez) {
    DisplayCalibration display = bent(radius, arc);
    display.image = {256, 192};  // silhouettes are a smaller share of more pixels
    display.modules[0].emitter.z = ez;
    return display;
  };
  for (const double radius : {2.0, -2.0, 1e9}) {
    for (const bool arc : {false, true}) {
      for (const double ez : {-0.2, -1e1, -1e2, -1e3, -1e4, -1e6}) {
        const std::string name = fmt::format("screen radius {:g} m{}, emitter {:g} m behind it", radius,
                                             arc ? ", observers on the arc" : "", -ez);
        if (radius < 0 && arc && ez > -1) {
          // So wide rays miss the arc.
          cases.push_back(refused(kGroup, name + ": before anything is rendered", "coverage",
                                  [=] { return accept_calibration(on_cylinder(radius, arc, ez)); }));
        } else {
          cases.push_back(drawn_true(kGroup, name, [=] { return with_display(on_cylinder(radius, arc, ez), 0.2); }));
        }
      }
    }
    cases.push_back(drawing_refused(kGroup, fmt::format("screen radius {:g} m, emitter 1e-3 m behind it", radius),
                                    "emitter: z", [radius] {
                                      DisplayCalibration display = bent(radius, false);
                                      display.modules[0].emitter.z = -1e-3;
                                      return with_display(display, 1e-3);
                                    }));
  }
}

void add_radii(StabilityCases& cases) {
  for (const double radius : {0.2, 1.0, 1e2, 1e4, 1e6, 1e9, 1e12, -0.5, -1e2, -1e4, -1e6, -1e9, -1e12}) {
    cases.push_back(drawn_true(kGroup, fmt::format("screen radius {:g} m", radius),
                               [radius] { return with_display(bent(radius, false), 0.2); }));
  }
  // The whole display shrinks with its screen: its sides are 0.8 and 0.6 of the radius.
  PictureBounds steep;
  steep.most_far_off = 2;
  steep.max = 1e-2;
  steep.why = "where two surfaces cross, interpolated depth says which is seen, on so curved a screen to 0.1 px";
  for (const double radius : {0.1, 1e-2, 2e-3, -0.1, -1e-2, -2e-3}) {
    cases.push_back(drawn_true(
        kGroup, fmt::format("screen radius {:g} m, everything as small", radius),
        [radius] { return scaled(bent(std::copysign(0.5, radius), false), std::abs(radius) / 0.5, 0.2); },
        radius > 0 ? steep : PictureBounds{}));
  }
  for (const double radius : {0.5, 2.0, 1e4, 1e9, -2.0, -1e4, -1e9}) {
    cases.push_back(drawn_true(kGroup, fmt::format("screen radius {:g} m, observers on the arc", radius),
                               [radius] { return with_display(bent(radius, true), 0.2); }));
  }
  for (const double radius : {1e-2, 0.1}) {
    cases.push_back(drawn_true(kGroup,
                               fmt::format("screen radius {:g} m, everything as small, observers on the arc", radius),
                               [radius] { return scaled(bent(0.5, true), radius / 0.5, 0.2); }));
  }
  for (const double radius : {-1e-2, -0.1, -0.5}) {
    cases.push_back(drawing_refused(kGroup,
                                    fmt::format("screen radius {:g} m, observers on the arc behind its axis", radius),
                                    "observer_arc", [radius] { return with_display(bent(radius, true), 0.2); }));
  }
}

void add_sizes(StabilityCases& cases) {
  const auto sized = [](ImageSize size) {
    DisplayCalibration display = small_display();
    display.image = size;
    return with_display(display);
  };
  PictureBounds few;
  few.least_compared_share = 0;
  few.least_compared = 0;
  few.why = "almost all pixels are near a silhouette";
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
  // A pixel is 1500 times as long as wide: corners, rounded to 1/256 of it, move by six of its widths.
  PictureBounds flat;
  flat.mismatch_share = 2e-3;
  flat.why = "corners are rounded to 1/256 of a pixel that is 1500 times as long as wide";
  cases.push_back(drawn_true(
      kGroup, "8192 x 4 pixels",
      [sized] {
        return sized({8192, 4});
      },
      flat));
  for (const ImageSize size : {ImageSize{4, 8192}, {8192, 256}, {256, 8192}})
    cases.push_back(
        drawn_true(kGroup, fmt::format("{} x {} pixels", size.width, size.height), [=] { return sized(size); }));
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
    cases.push_back(drawn_true(kGroup, fmt::format("a display {:g} times as large", scale),
                               [scale] { return scaled(small_display(), scale); }));
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
  add_distances_of_other_optics(cases);
  add_heights(cases);
  add_radii(cases);
  add_sizes(cases);
  add_homographies(cases);
  add_screens(cases);
}

}  // namespace lfd::bench
