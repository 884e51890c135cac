// Puts a scene together.
#include "controller/scene/scene_builder.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <utility>

#include "base/hash.h"
#include "base/log.h"
#include "controller/scene/limits.h"
#include "controller/scene/mesh_tools.h"
#include "proto/scene_numbers.h"

namespace lfd::scene {
namespace {

std::string store(Assets& assets, std::string bytes) {
  std::string hash = content_hash(bytes);
  assets.try_emplace(hash, std::make_shared<const std::string>(std::move(bytes)));
  return hash;
}

proto::Light white_light(proto::Light::Kind kind, float level) {
  proto::Light light;
  light.set_kind(kind);
  for (int channel = 0; channel < 3; ++channel) light.add_color(level);
  return light;
}

}  // namespace

bool mirrors(const glm::dmat4& world_from_mesh) { return glm::determinant(glm::dmat3(world_from_mesh)) < 0; }

std::array<double, 12> upper_rows(const glm::dmat4& matrix) {
  std::array<double, 12> rows{};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) rows[static_cast<std::size_t>(4 * row + column)] = matrix[column][row];
  }
  return rows;
}

void set_world_from_mesh(proto::Instance& instance, const glm::dmat4& world_from_mesh) {
  const std::array<double, 12> rows = upper_rows(world_from_mesh);
  instance.mutable_world_from_mesh()->Assign(rows.begin(), rows.end());
}

glm::dmat4 matrix_of(const proto::Instance& instance) {
  glm::dmat4 matrix(1.0);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) matrix[column][row] = instance.world_from_mesh(4 * row + column);
  }
  return matrix;
}

proto::Vector vector_message(glm::dvec3 v) {
  proto::Vector message;
  message.set_x(v.x);
  message.set_y(v.y);
  message.set_z(v.z);
  return message;
}

Result<std::string> SceneBuilder::add_mesh(MeshArrays arrays) {
  const proto::Mesh message = mesh_message(arrays);
  if (message.ByteSizeLong() > kMaxMeshBytes) {
    return Error(fmt::format("{} bytes of vertices and indices; at most {} travel in one mesh", message.ByteSizeLong(),
                             kMaxMeshBytes));
  }
  std::string hash = store(data_.assets, message.SerializeAsString());
  positions_.try_emplace(hash, std::move(arrays.position));
  return hash;
}

std::string SceneBuilder::add_mirror_of(const std::string& mesh) {
  if (const auto known = mirrors_.find(mesh); known != mirrors_.end()) return known->second;
  Result<MeshArrays> arrays = mesh_arrays(*data_.assets.at(mesh));
  LFD_CHECK(arrays, "a mesh that was added here is sound");
  swap_winding(*arrays);
  Result<std::string> mirror = add_mesh(*std::move(arrays));
  LFD_CHECK(mirror, "as large as the mesh that was accepted");
  mirrors_.emplace(mesh, *mirror);
  return *mirror;
}

std::string SceneBuilder::add_picture(std::string file) {
  proto::Picture picture;
  picture.set_file(std::move(file));
  return store(data_.assets, picture.SerializeAsString());
}

std::uint32_t SceneBuilder::add_material(proto::Material material) {
  *data_.scene.add_material() = std::move(material);
  return static_cast<std::uint32_t>(data_.scene.material_size() - 1);
}

Status SceneBuilder::add_instance(const std::string& mesh, std::uint32_t material, const glm::dmat4& world_from_mesh) {
  if (static_cast<std::size_t>(data_.scene.instance_size()) >= kMaxInstances) {
    return Error(fmt::format("more than {} instances", kMaxInstances));
  }
  placed_vertices_ += positions_.at(mesh).size();
  if (placed_vertices_ > kMaxPlacedVertices) {
    return Error(fmt::format("more than {} vertices in all instances together", kMaxPlacedVertices));
  }
  proto::Instance& instance = *data_.scene.add_instance();
  instance.set_mesh(mirrors(world_from_mesh) ? add_mirror_of(mesh) : mesh);
  instance.set_material(material);
  set_world_from_mesh(instance, world_from_mesh);
  return {};
}

Status SceneBuilder::add_bounds() {
  glm::dvec3 low(std::numeric_limits<double>::infinity());
  glm::dvec3 high = -low;
  for (const proto::Instance& instance : data_.scene.instance()) {
    const glm::dmat4 matrix = matrix_of(instance);
    for (const glm::vec3& p : positions_.at(instance.mesh())) {
      const glm::dvec3 p_in_world(matrix * glm::dvec4(p, 1.0));
      low = glm::min(low, p_in_world);
      high = glm::max(high, p_in_world);
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(low[axis]) || !std::isfinite(high[axis])) return Error("bounds in the world are not finite");
  }
  *data_.scene.mutable_bounds_low() = vector_message(low);
  *data_.scene.mutable_bounds_high() = vector_message(high);
  return {};
}

Result<SceneData> SceneBuilder::finish() && {
  if (data_.scene.instance_size() == 0) return Error("there is nothing to draw: the scene has no triangles");
  LFD_TRY_STATUS(check_numbers(data_.scene));
  LFD_TRY_STATUS(add_bounds());
  if (data_.scene.light_size() == 0) {
    add_light(white_light(proto::Light::AMBIENT, 0.3F));
    add_light(white_light(proto::Light::HEAD, 0.7F));
  }
  return std::move(data_);
}

}  // namespace lfd::scene
