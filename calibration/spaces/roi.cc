// Maps of the region of interest.
#include "calibration/spaces/roi.h"

#include <algorithm>
#include <cmath>

#include "base/log.h"

namespace lfd {
namespace {

// Far beyond anything that is shown, and far from where products and quotients of them leave double precision.
constexpr double kLeastSize_m = 1e-12, kMost_m = 1e12;

Status validate_size(const char* name, glm::dvec3 size) {
  for (int axis = 0; axis < 3; ++axis) {
    if (size[axis] >= kLeastSize_m && size[axis] <= kMost_m) continue;
    return Error(
        fmt::format("{}: {} m along {}; {} to {} are possible", name, size[axis], "xyz"[axis], kLeastSize_m, kMost_m));
  }
  return {};
}

template <class S>
Status validate_centre(const char* name, Point3<S> centre) {
  for (int axis = 0; axis < 3; ++axis) {
    const double place = to_glm(centre)[axis];
    if (std::abs(place) <= kMost_m) continue;
    return Error(fmt::format("{}: {} m along {}; {} to {} are possible", name, place, "xyz"[axis], -kMost_m, kMost_m));
  }
  return {};
}

}  // namespace

Status validate(const RegionOfInterest& roi) {
  LFD_TRY_STATUS(validate_centre("world_centre", roi.world_centre));
  LFD_TRY_STATUS(validate_centre("physical_centre", roi.physical_centre));
  LFD_TRY_STATUS(validate_size("world_size", roi.world_size));
  LFD_TRY_STATUS(validate_size("physical_size", roi.physical_size));
  const double norm = glm::length(roi.world_orientation);
  if (!(std::abs(norm - 1) <= 1e-6)) {
    return Error(fmt::format("world_orientation: a unit quaternion is needed, its length is {}", norm));
  }
  return {};
}

Affine<Physical, World> physical_from_world(const RegionOfInterest& roi) {
  const glm::dmat3 world_from_box = glm::mat3_cast(glm::normalize(roi.world_orientation));
  const glm::dvec3 scale = roi.physical_size / roi.world_size;
  const glm::dmat3 box_from_world = glm::transpose(world_from_box);
  glm::dmat3 linear;
  for (int column = 0; column < 3; ++column) linear[column] = scale * box_from_world[column];
  return {linear, to_glm(roi.physical_centre) - linear * to_glm(roi.world_centre)};
}

Affine<World, Physical> world_from_physical(const RegionOfInterest& roi) {
  const glm::dmat3 world_from_box = glm::mat3_cast(glm::normalize(roi.world_orientation));
  const glm::dvec3 scale = roi.world_size / roi.physical_size;
  glm::dmat3 linear;
  for (int column = 0; column < 3; ++column) linear[column] = world_from_box[column] * scale[column];
  return {linear, to_glm(roi.world_centre) - linear * to_glm(roi.physical_centre)};
}

RegionOfInterest fit_to_screen(Point3<World> low, Point3<World> high, double screen_width_m, double screen_height_m) {
  RegionOfInterest roi;
  roi.world_centre = midpoint(low, high);
  glm::dvec3 size = to_glm(high - low);
  const double diagonal = glm::length(size);
  const double least = diagonal > 0 ? 1e-6 * diagonal : 1.0;
  for (int axis = 0; axis < 3; ++axis) size[axis] = std::max(size[axis], least);
  roi.world_size = size;
  const double scale = std::min(screen_width_m / size.x, screen_height_m / size.y);
  roi.physical_size = scale * size;
  return roi;
}

Point3<World> position_origin(const RegionOfInterest& roi) {
  return glm::length(to_glm(roi.world_centre)) > 100 * roi.diagonal_m() ? roi.world_centre : Point3<World>{};
}

}  // namespace lfd
