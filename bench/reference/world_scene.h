// All triangles of a scene in the world and in physical space, in double precision: what the reference looks at.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "base/result.h"
#include "bench/reference/texture.h"
#include "calibration/spaces/roi.h"
#include "proto/scene_data.h"

namespace lfd::reference {

// Geometry is cut to far_z_m < z < near_z_m (physical; z grows toward the viewer).
struct ZLimits {
  double near_z_m = std::numeric_limits<double>::infinity();
  double far_z_m = -std::numeric_limits<double>::infinity();
};

struct Vertex {
  Point3<World> world;
  Point3<Physical> physical;
  Vector3<World> normal;  // unit, as stored in the mesh
  glm::dvec2 uv{0};
  glm::dvec4 color{1};  // linear
};

// Corners run counter-clockwise in the world seen from the front (scene.proto, Instance).
struct Triangle {
  std::array<std::uint32_t, 3> vertex;
  std::uint32_t instance = 0;
  std::uint32_t primitive = 0;  // number of the triangle within its mesh
  std::uint32_t material = 0;
};

struct Material {
  glm::dvec4 base_color{1};  // linear
  std::optional<std::uint32_t> texture;
  std::optional<double> alpha_cutoff;
  bool double_sided = false;
};

struct WorldScene {
  Affine<Physical, World> physical_from_world;
  Affine<World, Physical> world_from_physical;
  double roi_diagonal_m = 0;  // of the world box
  std::vector<Vertex> vertex;
  std::vector<Triangle> triangle;
  std::vector<Material> material;
  std::vector<Texture> texture;

  const Vertex& corner(const Triangle& t, int i) const { return vertex[t.vertex[i]]; }

  // Base colour (factor x texture x vertex colour, linear, with alpha) at barycentric coordinates of a triangle.
  glm::dvec4 base_color(const Triangle& t, glm::dvec3 barycentric) const;
};

// Places every instance: float32 mesh -> world -> physical, in double. Without a decoder every texture is white and
// opaque. Errors name the instance or the material: assets that are missing or broken, indices out of range,
// undecodable pictures.
Result<WorldScene> world_scene(const SceneData& data, const RegionOfInterest& roi);

}  // namespace lfd::reference
