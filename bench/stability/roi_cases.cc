// Regions of interest far away, flat, empty, and turned by something else than a rotation.
#include <array>
#include <cmath>
#include <limits>

#include "base/log.h"
#include "bench/stability/groups.h"
#include "calibration/maps/pinhole.h"
#include "calibration/spaces/roi.h"

namespace lfd::bench {
namespace {

constexpr const char* kGroup = "region of interest";
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

RegionOfInterest roi_at(double distance_m) {
  RegionOfInterest roi;
  roi.world_centre = {distance_m, -distance_m, distance_m};
  roi.world_size = {2, 1, 1.5};
  roi.physical_size = {0.4, 0.2, 0.3};
  return roi;
}

// The two maps there and back, against the box's own corners, which are known exactly.
void corners(Worst& worst, const RegionOfInterest& roi) {
  const auto to_physical = physical_from_world(roi);
  const auto to_world = world_from_physical(roi);
  const glm::dmat3 axes = glm::mat3_cast(roi.world_orientation);
  const double reach = glm::length(to_glm(roi.world_centre)) + roi.diagonal_m();
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 half(i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 4 ? 0.5 : -0.5);
    const glm::dvec3 world = to_glm(roi.world_centre) + axes * (half * roi.world_size);
    const glm::dvec3 physical = to_glm(roi.physical_centre) + half * roi.physical_size;
    const glm::dvec3 got = to_glm(to_physical * point_of<World>(world));
    const glm::dvec3 back = to_glm(to_world * point_of<Physical>(physical));
    for (int axis = 0; axis < 3; ++axis) {
      // The corner itself is rounded at the size of its coordinates.
      const double scale = roi.physical_size[axis] / roi.world_size[axis];
      worst.take((got[axis] - physical[axis]) / (kEpsilon * reach * scale));
      worst.take((back[axis] - world[axis]) / (kEpsilon * reach));
    }
  }
}

void add_far(StabilityCases& cases) {
  for (const double distance_m : {1e3, 1e6, 1e9}) {
    cases.push_back(bounded(kGroup, fmt::format("centre at {:g} m: corners both ways", distance_m), 16,
                            "roundings of a coordinate there",
                            [distance_m](Worst& worst) { corners(worst, roi_at(distance_m)); }));
    cases.push_back(faultless(kGroup, fmt::format("centre at {:g} m: position_origin", distance_m),
                              "the centre: it lies more than 100 diagonals away", [distance_m] {
                                const RegionOfInterest roi = roi_at(distance_m);
                                return position_origin(roi) == roi.world_centre ? "" : "another point";
                              }));
  }
  cases.push_back(faultless(kGroup, "centre at 100 m: position_origin", "the world's origin",
                            [] { return position_origin(roi_at(100)) == Point3<World>{} ? "" : "another point"; }));
}

void add_ratios(StabilityCases& cases) {
  for (const double ratio : {1e3, 1e6}) {
    cases.push_back(bounded(kGroup, fmt::format("axes of the world box as {:g} to 1: corners both ways", ratio), 16,
                            "roundings at the size of the box", [ratio](Worst& worst) {
                              for (const glm::dvec3 size :
                                   {glm::dvec3(ratio, 1, 1), glm::dvec3(1, ratio, 1), glm::dvec3(1, 1, 1 / ratio)}) {
                                RegionOfInterest roi = roi_at(0);
                                roi.world_size = size;
                                corners(worst, roi);
                                roi.world_orientation = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, 3)));
                                corners(worst, roi);
                              }
                            }));
  }
}

void add_sizes(StabilityCases& cases) {
  for (const double size : {0.0, -1.0, kNaN, kInfinity}) {
    for (int axis = 0; axis < 3; ++axis) {
      RegionOfInterest roi = roi_at(0);
      roi.world_size[axis] = size;
      cases.push_back(refused(kGroup, fmt::format("world size {} along {}", size, "xyz"[axis]),
                              fmt::format("world_size: {} along {}", size, "xyz"[axis]),
                              [roi] { return validate(roi); }));
      roi = roi_at(0);
      roi.physical_size[axis] = size;
      cases.push_back(refused(kGroup, fmt::format("physical size {} along {}", size, "xyz"[axis]),
                              fmt::format("physical_size: {} along {}", size, "xyz"[axis]),
                              [roi] { return validate(roi); }));
    }
  }
}

void add_orientations(StabilityCases& cases) {
  constexpr std::array kNotUnit{0.0, 1e-3, 0.9997, 1.0003, 2.0, 1e300, kNaN, kInfinity};
  for (const double length : kNotUnit) {
    RegionOfInterest roi = roi_at(0);
    roi.world_orientation = glm::dquat(length, 0, 0, 0);
    cases.push_back(refused(kGroup, fmt::format("orientation of length {}", length), "world_orientation",
                            [roi] { return validate(roi); }));
  }
  for (const double length : kNotUnit) {
    PinholeMap pinhole;
    pinhole.orientation = glm::dquat(0, length, 0, 0);
    cases.push_back(refused("pinhole", fmt::format("orientation of length {}", length), "orientation",
                            [pinhole] { return validate(pinhole); }));
  }
  cases.push_back(bounded(kGroup, "orientation of length 1 + 1.9e-4 is taken for a unit one", 4 * kEpsilon,
                          "of the rotation's columns", [](Worst& worst) {
                            RegionOfInterest roi = roi_at(0);
                            roi.world_size = roi.physical_size = glm::dvec3(1);
                            const glm::dquat unit = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, 3)));
                            roi.world_orientation = unit;
                            const glm::dmat3 expected = physical_from_world(roi).linear;
                            roi.world_orientation = (1 + 1.9e-4) * unit;
                            if (!validate(roi)) worst.take(kInfinity);
                            for (int column = 0; column < 3; ++column)
                              worst.take(glm::length(physical_from_world(roi).linear[column] - expected[column]));
                          }));
}

}  // namespace

void add_roi_cases(StabilityCases& cases) {
  add_far(cases);
  add_ratios(cases);
  add_sizes(cases);
  add_orientations(cases);
}

}  // namespace lfd::bench
