// Whole pictures of far, flat and tiny regions of interest.
#include "base/log.h"
#include "bench/stability/drawing.h"
#include "bench/stability/groups.h"
#include "bench/stability/spoilt_displays.h"

namespace lfd::bench {
namespace {

constexpr const char* kGroup = "pictures of regions";

Drawing drawing_of(const RegionOfInterest& roi) { return {small_display(), sphere_in_box(roi), roi, {}}; }

StabilityCase picture(std::string name, const RegionOfInterest& roi) {
  return drawn_true(kGroup, std::move(name), [roi] { return drawing_of(roi); });
}

const glm::dquat kTurned = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, 3)));

}  // namespace

void add_picture_cases(StabilityCases& cases) {
  for (const double distance_m : {0.0, 1e3, 1e6, 1e9}) {
    RegionOfInterest roi = small_roi();
    roi.world_centre = {distance_m, -distance_m, distance_m};
    cases.push_back(picture(fmt::format("centre at {:g} m, nodes translated there", distance_m), roi));
  }
  for (const double ratio : {1e3, 1e6}) {
    for (int axis = 0; axis < 3; ++axis) {
      RegionOfInterest roi = small_roi();
      roi.world_size[axis] *= ratio;
      cases.push_back(picture(fmt::format("{:g} times longer along {}", ratio, "xyz"[axis]), roi));
      roi.world_orientation = kTurned;
      cases.push_back(picture(fmt::format("{:g} times longer along {}, turned", ratio, "xyz"[axis]), roi));
      roi = small_roi();
      roi.world_size[axis] /= ratio;
      cases.push_back(picture(fmt::format("{:g} times shorter along {}, turned", ratio, "xyz"[axis]), roi));
    }
  }
  for (const double ratio : {1e3, 9e3}) {
    RegionOfInterest roi = small_roi();
    roi.physical_size.z /= ratio;
    cases.push_back(picture(fmt::format("{:g} times shorter along z in physical space alone", ratio), roi));
  }
  for (const double ratio : {1e5, 1e6}) {
    RegionOfInterest roi = small_roi();
    roi.physical_size.z /= ratio;
    cases.push_back(drawing_refused(kGroup, fmt::format("{:g} times shorter along z in physical space alone", ratio),
                                    "physical_size: one axis is magnified", [roi] { return drawing_of(roi); }));
  }
  // Other pictures are lit, in sRGB.
  for (const bool unlit : {false, true}) {
    for (const bool with_color : {false, true}) {
      if (!unlit && !with_color) continue;
      cases.push_back(drawn_true(
          kGroup, fmt::format("{}, {}", unlit ? "unlit" : "lit", with_color ? "with a colour calibration" : "in sRGB"),
          [=] {
            Drawing drawing = drawing_of(small_roi());
            if (with_color) drawing.display.modules[0].color = measured_color();
            drawing.settings.set_unlit(unlit);
            drawing.settings.mutable_background()->set_g(0.25);
            return drawing;
          }));
    }
  }
  for (const double scale : {1e-8, 1e-4, 1e4, 1e11}) {
    RegionOfInterest roi = small_roi();
    roi.world_size *= scale;
    cases.push_back(picture(fmt::format("a world {:g} times as large", scale), roi));
    roi.world_orientation = kTurned;
    cases.push_back(picture(fmt::format("a world {:g} times as large, turned", scale), roi));
  }
}

}  // namespace lfd::bench
