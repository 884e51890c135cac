// The list of what is supported, held against a model.
#include "controller/scene/gltf/support.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "base/log.h"

namespace lfd::scene::gltf {
namespace {

constexpr std::array<std::string_view, 4> kSupported = {"KHR_lights_punctual", "KHR_materials_unlit",
                                                        "KHR_mesh_quantization", "KHR_texture_transform"};

bool is_supported(const std::string& extension) { return std::ranges::find(kSupported, extension) != kSupported.end(); }

void add_of_meshes(const tinygltf::Model& model, std::set<std::string>& found) {
  for (const tinygltf::Mesh& mesh : model.meshes) {
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      if (!primitive.targets.empty()) found.insert("morph targets");
      if (primitive.mode == TINYGLTF_MODE_POINTS) found.insert("points");
      if (primitive.mode >= TINYGLTF_MODE_LINE && primitive.mode <= TINYGLTF_MODE_LINE_STRIP) found.insert("lines");
    }
  }
}

void add_of_materials(const tinygltf::Model& model, std::set<std::string>& found) {
  for (const tinygltf::Material& material : model.materials) {
    if (material.alphaMode == "BLEND") found.insert("alpha blending (drawn opaque)");
    if (material.normalTexture.index >= 0) found.insert("normal textures");
    if (material.occlusionTexture.index >= 0) found.insert("occlusion textures");
    if (material.pbrMetallicRoughness.metallicRoughnessTexture.index >= 0) found.insert("metallic-roughness textures");
    const bool glows = std::ranges::any_of(material.emissiveFactor, [](double factor) { return factor > 0; });
    if (glows) found.insert("emission");
  }
}

void add_of_animations(const tinygltf::Model& model, std::set<std::string>& found) {
  for (const tinygltf::Animation& animation : model.animations) {
    for (const tinygltf::AnimationChannel& channel : animation.channels) {
      if (channel.target_path == "weights") {
        found.insert("morph targets");
      } else if (channel.target_path != "translation" && channel.target_path != "rotation" &&
                 channel.target_path != "scale") {
        found.insert("animation of other properties");
      }
    }
  }
}

}  // namespace

Status check_required_extensions(const tinygltf::Model& model) {
  for (const std::string& extension : model.extensionsRequired) {
    if (!is_supported(extension)) return Error(fmt::format("extension {} is required and not supported", extension));
  }
  return {};
}

std::vector<std::string> unsupported(const tinygltf::Model& model) {
  std::set<std::string> found;
  if (!model.skins.empty()) found.insert("skins");
  if (!model.cameras.empty()) found.insert("cameras");
  add_of_meshes(model, found);
  add_of_materials(model, found);
  add_of_animations(model, found);
  for (const std::string& extension : model.extensionsUsed) {
    if (!is_supported(extension)) found.insert(extension);
  }
  return {found.begin(), found.end()};
}

}  // namespace lfd::scene::gltf
