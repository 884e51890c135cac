// Puts a scene together: assets by content hash (each once), instances, materials, lights, bounds.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/result.h"
#include "proto/mesh_arrays.h"
#include "proto/scene_data.h"

namespace lfd::scene {

class SceneBuilder {
 public:
  explicit SceneBuilder(std::string name) { data_.scene.set_name(std::move(name)); }

  // The content hash of the mesh. Refuses a mesh that is too large to travel.
  Result<std::string> add_mesh(MeshArrays arrays);

  // The content hash of the same mesh with the other winding, for instances whose transform mirrors.
  std::string add_mirror_of(const std::string& mesh);

  // The content hash of the picture. `file` is an encoded image; it is not looked into.
  std::string add_picture(std::string file);

  std::uint32_t add_material(proto::Material material);
  void add_light(proto::Light light) { *data_.scene.add_light() = std::move(light); }

  // Places a mesh that was added. Where the transform mirrors, the mesh placed is the one with the other winding, so
  // that counter-clockwise is the front in the world.
  Status add_instance(const std::string& mesh, std::uint32_t material, const glm::dmat4& world_from_mesh);

  // Closes the scene: bounds, and lights if there are none. Refuses a scene without triangles or with bounds that are
  // not finite.
  Result<SceneData> finish() &&;

 private:
  Status add_bounds();

  SceneData data_;
  std::unordered_map<std::string, std::vector<glm::vec3>> positions_;  // of meshes, by hash
  std::unordered_map<std::string, std::string> mirrors_;               // hash of the mirror by hash of the mesh
  std::size_t placed_vertices_ = 0;
};

// True where the transform turns right hands into left ones.
bool mirrors(const glm::dmat4& world_from_mesh);

// The 12 numbers of proto::Instance: upper three rows, row-major.
std::array<double, 12> upper_rows(const glm::dmat4& matrix);
void set_world_from_mesh(proto::Instance& instance, const glm::dmat4& world_from_mesh);

// Back again, with the last row 0 0 0 1.
glm::dmat4 matrix_of(const proto::Instance& instance);

proto::Vector vector_message(glm::dvec3 v);

}  // namespace lfd::scene
