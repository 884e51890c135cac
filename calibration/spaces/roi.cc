// Maps of the region of interest.
#include "calibration/spaces/roi.h"

#include <algorithm>
#include <cmath>

#include "calibration/limits.h"

namespace lfd {
namespace {

Status validate_size(const char* name, glm::dvec3 size, Limits limits) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(size[axis] > 0) || !std::isfinite(size[axis])) {
      return Error(fmt::format("{}: {} along {} must be positive and finite", name, size[axis], "xyz"[axis]));
    }
    LFD_TRY_STATUS(check_magnitude(name, size[axis], limits));
  }
  const auto [least, most] = std::minmax({size.x, size.y, size.z});
  if (most <= kMostRoiRatio * least) return {};
  return Error(fmt::format("{}: {} to {} is a ratio of {:g}; at most {:g} is possible", name, most, least, most / least,
                           kMostRoiRatio));
}

}  // namespace

Status validate(const RegionOfInterest& roi) {
  if (!is_finite(roi.world_centre)) return Error("world_centre: must be finite");
  if (!is_finite(roi.physical_centre)) return Error("physical_centre: must be finite");
  LFD_TRY_STATUS(validate_size("world_size", roi.world_size, kRoiWorldSize_m));
  LFD_TRY_STATUS(validate_size("physical_size", roi.physical_size, kRoiPhysicalSize_m));
  // Its square may be beyond double precision, and the length itself too.
  const glm::dvec3 centre = to_glm(roi.world_centre);
  const long double away = std::hypot<long double>(centre.x, centre.y, centre.z);
  if (!(away <= kFarthestRoi * roi.diagonal_m())) {
    return Error(fmt::format("world_centre: {:g} m from the origin are more than {:g} diagonals: double precision ends",
                             away, kFarthestRoi));
  }
  const glm::dvec3 scale = roi.world_size / roi.physical_size;
  const double magnification =
      std::max({scale.x, scale.y, scale.z}) * glm::length(roi.physical_size) / roi.diagonal_m();
  if (!(magnification <= kMostRoiMagnification)) {
    return Error(
        fmt::format("physical_size: one axis is magnified {:g} times more than the others; at most {:g} is possible",
                    magnification, kMostRoiMagnification));
  }
  for (const double place : {roi.physical_centre.x, roi.physical_centre.y, roi.physical_centre.z}) {
    LFD_TRY_STATUS(check_magnitude("physical_centre", place, kPlace_m));
  }
  const glm::dquat& turn = roi.world_orientation;
  const double norm = std::hypot(std::hypot(turn.w, turn.x), std::hypot(turn.y, turn.z));  // its square may overflow
  if (!(std::abs(norm - 1) <= kUnitLengthError)) {
    return Error(
        fmt::format("world_orientation: a unit quaternion is needed (its length within {:g} of 1), its length is {}",
                    kUnitLengthError, norm));
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
