// The region of interest: the box of the world that a display shows, and the box of physical space it is shown in.
#pragma once

#include <glm/gtc/quaternion.hpp>

#include "base/result.h"
#include "calibration/spaces/affine.h"

namespace lfd {

// An oriented box in the world, an axis-aligned box in physical space. Sizes are full edge lengths in metres.
// Orientation turns the box's axes into the world's; it is a unit quaternion (w, x, y, z).
struct RegionOfInterest {
  Point3<World> world_centre;
  glm::dvec3 world_size{1.0};
  glm::dquat world_orientation{1.0, 0.0, 0.0, 0.0};
  Point3<Physical> physical_centre;
  glm::dvec3 physical_size{1.0};
  bool operator==(const RegionOfInterest&) const = default;

  // Length of the world box's diagonal, in metres: "the ROI diagonal" everywhere.
  double diagonal_m() const { return glm::length(world_size); }
};

// Refuses sizes that are not positive and finite, centres that are not finite, orientations that are not of unit length
// (1e-6), and boxes too large, small, flat or far away for the precision there is (calibration/limits.h).
Status validate(const RegionOfInterest& roi);

// The affine map that takes the world box to the physical one. `roi` is valid.
Affine<Physical, World> physical_from_world(const RegionOfInterest& roi);

// Its inverse, built from the boxes themselves, so that it is as accurate as the map.
Affine<World, Physical> world_from_physical(const RegionOfInterest& roi);

// The default: the box `low`..`high` of the world, uniformly scaled to fit a screen of this size, centred at the
// screen's centre. A box without extent in some direction is given a small one (1e-6 of its diagonal; 1 m where it is a
// point).
RegionOfInterest fit_to_screen(Point3<World> low, Point3<World> high, double screen_width_m, double screen_height_m);

// What position buffers are measured from: the world's origin, or the centre of the region of interest where that lies
// more than 100 diagonals away from it (single precision would not hold the positions there).
Point3<World> position_origin(const RegionOfInterest& roi);

}  // namespace lfd
