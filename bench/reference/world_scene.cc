// Meshes to placed triangles.
#include "bench/reference/world_scene.h"

#include <glm/geometric.hpp>
#include <string>
#include <unordered_map>

#include "base/log.h"
#include "proto/mesh_arrays.h"
#include "proto/pictures/decode.h"

namespace lfd::reference {
namespace {

struct Placement {
  glm::dmat3 linear{1.0};
  glm::dvec3 offset{0.0};
};

Result<Placement> placement_of(const proto::Instance& instance) {
  const auto& m = instance.world_from_mesh();
  if (m.size() != 12) return Error(fmt::format("world_from_mesh: {} numbers, 12 are needed", m.size()));
  Placement placement;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) placement.linear[column][row] = m[4 * row + column];
    placement.offset[row] = m[4 * row + 3];
  }
  return placement;
}

// Normals go with the inverse transpose; the cofactors are it up to a factor and exist for singular maps too.
glm::dmat3 cofactors(const glm::dmat3& m) {
  return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

Vector3<World> unit_or_zero(glm::dvec3 v) {
  const double length = glm::length(v);
  return vector_of<World>(length > 0 ? v / length : glm::dvec3(0));
}

void place(const MeshArrays& mesh, const Placement& placement, std::uint32_t instance, std::uint32_t material,
           WorldScene& scene) {
  const std::uint32_t first = static_cast<std::uint32_t>(scene.vertex.size());
  const bool mirrored = glm::determinant(placement.linear) < 0;
  const glm::dmat3 world_normal_from_mesh = (mirrored ? -1.0 : 1.0) * cofactors(placement.linear);
  for (std::size_t i = 0; i < mesh.position.size(); ++i) {
    Vertex v;
    v.world = point_of<World>(placement.linear * glm::dvec3(mesh.position[i]) + placement.offset);
    v.physical = scene.physical_from_world * v.world;
    v.normal = unit_or_zero(world_normal_from_mesh * glm::dvec3(mesh.normal[i]));
    if (!mesh.uv.empty()) v.uv = mesh.uv[i];
    if (!mesh.color.empty()) v.color = mesh.color[i];
    scene.vertex.push_back(v);
  }
  for (std::uint32_t i = 0; i < mesh.index.size() / 3; ++i) {
    const std::uint32_t a = first + mesh.index[3 * i], b = first + mesh.index[3 * i + 1],
                        c = first + mesh.index[3 * i + 2];
    scene.triangle.push_back({{a, b, c}, instance, i, material});
  }
}

Result<Texture> texture_of(const proto::Texture& description, const SceneData& data) {
  const auto asset = data.assets.find(description.picture());
  if (asset == data.assets.end()) return Error(fmt::format("picture {} is missing", description.picture()));
  proto::Picture picture;
  if (!picture.ParseFromString(*asset->second)) return Error("the picture asset cannot be parsed");
  LFD_TRY(const Picture8 decoded, decode_picture(picture.file()));
  return Texture::make(description, decoded);
}

Result<Material> material_of(const proto::Material& from, const SceneData& data, std::vector<Texture>& textures) {
  Material material;
  const auto& color = from.base_color();
  if (color.size() != 0 && color.size() != 4)
    return Error(fmt::format("base_color: {} numbers, 4 are needed", color.size()));
  if (color.size() == 4) material.base_color = {color[0], color[1], color[2], color[3]};
  if (from.has_alpha_cutoff()) material.alpha_cutoff = from.alpha_cutoff();
  material.double_sided = from.double_sided();
  if (from.has_texture()) {
    LFD_TRY(Texture texture, texture_of(from.texture(), data));
    material.texture = static_cast<std::uint32_t>(textures.size());
    textures.push_back(std::move(texture));
  }
  return material;
}

Status add_instance(const SceneData& data, std::uint32_t number, std::unordered_map<std::string, MeshArrays>& meshes,
                    WorldScene& scene) {
  const proto::Instance& instance = data.scene.instance(static_cast<int>(number));
  if (instance.material() >= scene.material.size())
    return Error(fmt::format("material {} of {}", instance.material(), scene.material.size()));
  LFD_TRY(const Placement placement, placement_of(instance));
  if (!meshes.contains(instance.mesh())) {
    const auto asset = data.assets.find(instance.mesh());
    if (asset == data.assets.end()) return Error(fmt::format("mesh {} is missing", instance.mesh()));
    LFD_TRY(meshes[instance.mesh()], mesh_arrays(*asset->second));
  }
  place(meshes[instance.mesh()], placement, number, instance.material(), scene);
  return {};
}

}  // namespace

glm::dvec4 WorldScene::base_color(const Triangle& t, glm::dvec3 barycentric) const {
  const Material& m = material[t.material];
  glm::dvec4 color(0);
  glm::dvec2 uv(0);
  for (int i = 0; i < 3; ++i) {
    color += barycentric[i] * corner(t, i).color;
    uv += barycentric[i] * corner(t, i).uv;
  }
  color *= m.base_color;
  return m.texture ? color * texture[*m.texture].sample(uv) : color;
}

Result<WorldScene> world_scene(const SceneData& data, const RegionOfInterest& roi) {
  WorldScene scene;
  scene.physical_from_world = physical_from_world(roi);
  scene.world_from_physical = world_from_physical(roi);
  scene.roi_diagonal_m = roi.diagonal_m();
  for (int i = 0; i < data.scene.material_size(); ++i) {
    auto material = material_of(data.scene.material(i), data, scene.texture);
    if (!material) return material.error().within(fmt::format("material {}", i));
    scene.material.push_back(*material);
  }
  std::unordered_map<std::string, MeshArrays> meshes;
  for (int i = 0; i < data.scene.instance_size(); ++i) {
    if (auto status = add_instance(data, static_cast<std::uint32_t>(i), meshes, scene); !status) {
      return status.error().within(fmt::format("instance {}", i));
    }
  }
  return scene;
}

}  // namespace lfd::reference
