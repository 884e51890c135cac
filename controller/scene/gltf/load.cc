// A glTF file to a scene: the order in which its parts are read.
#include <algorithm>
#include <map>
#include <utility>

#include "base/file.h"
#include "base/log.h"
#include "controller/scene/gltf/channels.h"
#include "controller/scene/gltf/document.h"
#include "controller/scene/gltf/lights.h"
#include "controller/scene/gltf/materials.h"
#include "controller/scene/gltf/nodes.h"
#include "controller/scene/gltf/primitives.h"
#include "controller/scene/gltf/support.h"
#include "controller/scene/limits.h"
#include "controller/scene/loaded_scene.h"
#include "controller/scene/scene_builder.h"

namespace lfd {
namespace scene::gltf {
namespace {

// A primitive that was read: what an instance of it names.
struct Part {
  std::string mesh;  // content hash
  std::uint32_t material = 0;
};

class Loader {
 public:
  Loader(const Document& document, std::string name) : document_(document), scene_(std::move(name)) {}

  Result<LoadedScene> load() {
    warn_of_unsupported();
    LFD_TRY(nodes_, read_nodes(model_));
    LFD_TRY(materials_, read_materials(document_, scene_, warnings_));
    LFD_TRY(channels_, read_channels(model_, nodes_.tree, nodes_.tree_node));
    find_turning_nodes();
    world_from_node_ = world_from_nodes(nodes_.tree);
    for (std::size_t node = 0; node < nodes_.tree.size(); ++node) {
      const std::size_t model_node = nodes_.model_node[node];
      const Status placed = place(node, model_.nodes[model_node]);
      if (!placed) return placed.error().within(label("node", model_node, model_.nodes[model_node].name));
    }
    LoadedScene result;
    LFD_TRY(result.data, std::move(scene_).finish());
    if (!channels_.empty()) {
      result.animations = Animations(nodes_.tree, std::move(channels_), instances_, lights_);
    }
    if (untextured_ > 0) {
      warnings_.push_back(fmt::format("{} primitives are drawn without the texture of their material (the first is {})",
                                      untextured_, first_untextured_));
    }
    if (mended_ > 0) {
      warnings_.push_back(
          fmt::format("{} texture coordinates or vertex colours are not finite: 0 is taken (the first in {})", mended_,
                      first_mended_));
    }
    result.warnings = std::move(warnings_);
    return result;
  }

 private:
  void warn_of_unsupported() {
    const std::vector<std::string> names = unsupported(model_);
    if (!names.empty()) warnings_.push_back(fmt::format("not supported and left out: {}", fmt::join(names, ", ")));
  }

  // Nodes whose transform may come to mirror while a scale is animated through zero, and all below them.
  void find_turning_nodes() {
    turning_.assign(nodes_.tree.size(), false);
    for (const Channel& channel : channels_) {
      const bool negative =
          std::ranges::any_of(channel.values, [](glm::dvec4 v) { return v.x < 0 || v.y < 0 || v.z < 0; });
      if (channel.path == Channel::Path::kScale && negative) turning_[channel.node] = true;
    }
    for (std::size_t node = 0; node < turning_.size(); ++node) {
      const int parent = nodes_.tree[node].parent;
      if (parent >= 0 && turning_[static_cast<std::size_t>(parent)]) turning_[node] = true;
    }
  }

  Status place(std::size_t node, const tinygltf::Node& from) {
    Result<std::optional<proto::Light>> light = light_of(model_, from);
    if (!light) return light.error();
    if (*light) {
      scene_.add_light(light_in_world(**light, world_from_node_[node]));
      lights_.push_back({node, **std::move(light)});
    }
    if (from.mesh == -1) return {};
    LFD_TRY(const std::vector<Part>* parts, parts_of(from.mesh));
    for (const Part& part : *parts) {
      const glm::dmat4& world_from_mesh = world_from_node_[node];
      LFD_TRY_STATUS(scene_.add_instance(part.mesh, part.material, world_from_mesh));
      const bool may_mirror = turning_[node] || mirrors(world_from_mesh);
      instances_.push_back({node, part.material, part.mesh, may_mirror ? scene_.add_mirror_of(part.mesh) : ""});
    }
    return {};
  }

  // The parts of a mesh, read when first needed.
  Result<const std::vector<Part>*> parts_of(int mesh) {
    if (const auto known = parts_.find(mesh); known != parts_.end()) return &known->second;
    LFD_TRY(const tinygltf::Mesh* from, item_at(model_.meshes, mesh, "mesh"));
    std::vector<Part>& parts = parts_[mesh];
    const std::string place = label("mesh", static_cast<std::size_t>(mesh), from->name);
    for (std::size_t i = 0; i < from->primitives.size(); ++i) {
      if (!has_triangles(from->primitives[i])) {
        LFD_TRY_STATUS(check_mode(from->primitives[i].mode, fmt::format("{}: primitive {}", place, i)));
        continue;
      }
      Result<Part> part = read_part(from->primitives[i], fmt::format("{}: primitive {}", place, i));
      if (!part) return part.error().within(fmt::format("{}: primitive {}", place, i));
      if (!part->mesh.empty()) parts.push_back(*std::move(part));
    }
    return &parts;
  }

  static Status check_mode(int mode, const std::string& place) {
    if (mode >= TINYGLTF_MODE_POINTS && mode <= TINYGLTF_MODE_LINE_STRIP) return {};  // the warning names them
    return Error(fmt::format("{}: mode {} is not one of glTF", place, mode));
  }

  Status count(const Size& size) {
    if (size.vertices > kMaxVertices || size.indices > kMaxIndices) {
      return Error(fmt::format("{} vertices and {} indices; at most {} and {} are read", size.vertices, size.indices,
                               kMaxVertices, kMaxIndices));
    }
    total_.vertices += size.vertices;
    total_.indices += size.indices;
    if (total_.vertices > kMaxVertices || total_.indices > kMaxIndices) {
      return Error(fmt::format("the file has {} vertices and {} indices up to here; at most {} and {} are read",
                               total_.vertices, total_.indices, kMaxVertices, kMaxIndices));
    }
    return {};
  }

  Result<ReadMaterial> material_of(const tinygltf::Primitive& primitive) const {
    if (primitive.material == -1) return materials_.back();
    if (const auto exists = item_at(model_.materials, primitive.material, "material"); !exists) return exists.error();
    return materials_[static_cast<std::size_t>(primitive.material)];
  }

  // A part without a mesh: the primitive has no whole triangle.
  Result<Part> read_part(const tinygltf::Primitive& primitive, const std::string& place) {
    LFD_TRY_STATUS(count(claimed_size(model_, primitive)));
    LFD_TRY(const ReadMaterial material, material_of(primitive));
    const std::size_t mended_before = mended_;
    LFD_TRY(MeshArrays arrays, read_primitive(model_, primitive, material.uv_set, mended_));
    if (mended_before == 0 && mended_ > 0) first_mended_ = place;
    if (arrays.index.empty()) return Part{};
    if (material.uv_set >= 0 && arrays.uv.empty()) {
      if (untextured_++ == 0) first_untextured_ = fmt::format("{}: no TEXCOORD_{}", place, material.uv_set);
    }
    LFD_TRY(std::string mesh, scene_.add_mesh(std::move(arrays)));
    return Part{std::move(mesh), material.index};
  }

  const Document& document_;
  const tinygltf::Model& model_ = document_.model;
  SceneBuilder scene_;
  ReadNodes nodes_;
  std::vector<glm::dmat4> world_from_node_;  // by tree node, at rest
  std::vector<bool> turning_;                // by tree node
  std::vector<ReadMaterial> materials_;      // by material of the model; beyond: for primitives without one
  std::vector<Channel> channels_;
  std::map<int, std::vector<Part>> parts_;  // by mesh of the model
  std::vector<PlacedInstance> instances_;
  std::vector<PlacedLight> lights_;
  Size total_;
  int untextured_ = 0;  // primitives whose material has a texture that they have no place in
  std::string first_untextured_;
  std::size_t mended_ = 0;  // texture coordinates and vertex colours that are not finite
  std::string first_mended_;
  std::vector<std::string> warnings_;
};

Result<LoadedScene> load(std::string_view content, const std::filesystem::path& path) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  LFD_TRY(const Document document, read_document(content, folder));
  return Loader(document, path.stem().string()).load();
}

}  // namespace
}  // namespace scene::gltf

Result<LoadedScene> load_scene(const std::filesystem::path& path) {
  LFD_TRY(const std::string content, read_file(path));
  Result<LoadedScene> scene = scene::gltf::load(content, path);
  if (!scene) return scene.error().within(path.string());
  return scene;
}

}  // namespace lfd
