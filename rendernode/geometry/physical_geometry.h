// A scene's triangles as they are drawn: in physical space, cut at the limits in z, long edges split, each with its
// exact plane.
//
// Everything here is computed in double precision and rounded once: however far from the world's origin the region of
// interest lies, and however small it is, the GPU sees coordinates of the size of the screen.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/result.h"
#include "calibration/spaces/roi.h"
#include "proto/mesh_arrays.h"
#include "proto/scene_data.h"
#include "rendernode/geometry/depth_limits.h"
#include "rendernode/geometry/edge_rule.h"
#include "shaders/shared/glsl_types.h"

namespace lfd {

// A corner as the vertex shader reads it; 36 bytes.
struct SurfaceVertex {
  float position[3];       // physical, metres
  std::int16_t normal[4];  // world, unit, signed normalised; w unused
  float uv[2];
  std::uint16_t color[4];  // half floats
};
static_assert(sizeof(SurfaceVertex) == 36);

// The triangles of one instance; what is drawn or left out as a whole.
struct GeometryItem {
  std::uint32_t first_index = 0, index_count = 0;
  std::uint32_t primitive_base = 0;  // of its planes
  std::uint32_t material = 0;
  Point3<Physical> low, high;  // bounds
  std::string content = {};    // hash of the instance: equal ones have equal triangles in the same region of interest
};

struct PhysicalGeometry {
  std::vector<SurfaceVertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<shared::PrimitivePlane> planes;  // one per triangle
  std::vector<GeometryItem> items;             // without the empty ones
  std::uint64_t source_triangles = 0;
  std::uint64_t degenerate_triangles = 0;  // without an area, or not finite: not drawn
  std::uint64_t cut_triangles = 0;         // cut by a limit in z, or wholly beyond it
};

// Decoded meshes by content hash, kept from one build to the next.
using MeshCache = std::unordered_map<std::string, MeshArrays>;

// Triangles after cutting and splitting: 6 GB of memory. Lenses that bend absurdly would split a wall into as many.
inline constexpr std::size_t kMostTriangles = std::size_t{1} << 25;

// Errors name the instance and what its mesh lacks, or that more than most_triangles are needed. All meshes of the
// scene are in `assets`.
Result<PhysicalGeometry> build_geometry(const proto::Scene& scene, const Assets& assets, MeshCache& cache,
                                        const RegionOfInterest& roi, const DepthLimits& limits, const EdgeRule& rule,
                                        std::size_t most_triangles = kMostTriangles);

}  // namespace lfd
