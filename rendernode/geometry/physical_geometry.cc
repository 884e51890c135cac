// Instances to physical space.
#include "rendernode/geometry/physical_geometry.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "base/hash.h"
#include "base/log.h"
#include "rendernode/geometry/triangle_feed.h"

namespace lfd {
namespace {

Result<const MeshArrays*> mesh_of(const std::string& hash, const Assets& assets, MeshCache& cache) {
  if (const auto known = cache.find(hash); known != cache.end()) return &known->second;
  const auto asset = assets.find(hash);
  if (asset == assets.end()) return Error(fmt::format("mesh {} is missing", hash));
  LFD_TRY(MeshArrays arrays, mesh_arrays(*asset->second));
  return &cache.emplace(hash, std::move(arrays)).first->second;
}

// world_from_mesh of an instance message, in row-major 3x4.
struct Mesh {};
Result<Affine<World, Mesh>> placement_of(const proto::Instance& instance) {
  if (instance.world_from_mesh_size() != 12) return Error("world_from_mesh: 12 numbers are needed");
  Affine<World, Mesh> placement;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      placement.linear[column][row] = instance.world_from_mesh(4 * row + column);
    placement.offset[row] = instance.world_from_mesh(4 * row + 3);
  }
  return placement;
}

// Normals go by the cofactors, the inverse transpose up to a positive factor, which also exists where a scale is zero.
glm::dmat3 normal_map(const glm::dmat3& m) {
  const double sign = glm::determinant(m) < 0 ? -1 : 1;
  return {sign * glm::cross(m[1], m[2]), sign * glm::cross(m[2], m[0]), sign * glm::cross(m[0], m[1])};
}

std::vector<Corner> corners_of(const MeshArrays& mesh, const Affine<World, Mesh>& world_from_mesh,
                               const RegionOfInterest& roi) {
  // World points are counted from the ROI centre before they are scaled: no digits are lost far from the origin.
  const glm::dmat3 physical_from_world_linear = physical_from_world(roi).linear;
  const glm::dvec3 offset = world_from_mesh.offset - to_glm(roi.world_centre);
  const glm::dmat3 normal_from_mesh = normal_map(world_from_mesh.linear);
  std::vector<Corner> corners(mesh.position.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 world = world_from_mesh.linear * glm::dvec3(mesh.position[i]) + offset;
    corners[i].position = point_of<Physical>(physical_from_world_linear * world + to_glm(roi.physical_centre));
    const glm::dvec3 normal = normal_from_mesh * glm::dvec3(mesh.normal[i]);
    const double length = glm::length(normal);
    corners[i].normal = length > 0 && std::isfinite(length) ? normal / length : glm::dvec3(0, 0, 1);
    if (!mesh.uv.empty()) corners[i].uv = mesh.uv[i];
    if (!mesh.color.empty()) corners[i].color = mesh.color[i];
  }
  return corners;
}

// Physical metres that are nowhere more than kSlackShare of the diagonal in the world. Large enough that a flat wall of
// several triangles has no seams where it is grazed, small enough that a crease is true to a third of the bound of
// 1e-3.
constexpr double kSlackShare = 3e-4;

double slack_m(const RegionOfInterest& roi) {
  const glm::dvec3 scale = roi.world_size / roi.physical_size;
  return kSlackShare * roi.diagonal_m() / std::max({scale.x, scale.y, scale.z});
}

}  // namespace

Result<PhysicalGeometry> build_geometry(const proto::Scene& scene, const Assets& assets, MeshCache& cache,
                                        const RegionOfInterest& roi, const DepthLimits& limits, const EdgeRule& rule,
                                        std::size_t most_triangles) {
  PhysicalGeometry geometry;
  TriangleFeed feed(limits, rule, slack_m(roi), geometry);
  for (int i = 0; i < scene.instance_size(); ++i) {
    const auto& instance = scene.instance(i);
    const auto fail = [i](const Error& error) { return error.within(fmt::format("instance {}", i)); };
    auto placement = placement_of(instance);
    if (!placement) return fail(placement.error());
    auto mesh = mesh_of(instance.mesh(), assets, cache);
    if (!mesh) return fail(mesh.error());
    if (instance.material() >= static_cast<std::uint32_t>(scene.material_size())) {
      return fail(Error(fmt::format("material {} of {}", instance.material(), scene.material_size())));
    }
    feed.begin_item(instance.material(), corners_of(**mesh, *placement, roi));
    const auto& index = (*mesh)->index;
    for (std::size_t t = 0; t + 2 < index.size(); t += 3) {
      feed.add(index[t], index[t + 1], index[t + 2]);
      if (geometry.planes.size() <= most_triangles) continue;
      return fail(Error(fmt::format(
          "more than {} triangles where edges are split as the modules' maps bend: a coarser subdivision_px, smoother "
          "maps or a smaller scene is needed",
          most_triangles)));
    }
    feed.end_item(content_hash(instance.SerializeAsString()));
  }
  return geometry;
}

}  // namespace lfd
