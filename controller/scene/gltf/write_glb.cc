// A scene as a glb file: each array a buffer view, each instance a node.
#include <glm/mat4x4.hpp>
#include <limits>
#include <map>
#include <numbers>
#include <sstream>
#include <tuple>

#include <tiny_gltf.h>

#include "base/file.h"
#include "base/log.h"
#include "controller/scene/mesh_tools.h"
#include "controller/scene/scene_builder.h"
#include "controller/scene/scene_file.h"

namespace lfd::scene {
namespace {

class Writer {
 public:
  explicit Writer(const SceneData& data) : data_(data) {
    model_.buffers.emplace_back();
    model_.scenes.emplace_back().name = data.scene.name();
    model_.defaultScene = 0;
    model_.asset.version = "2.0";
    model_.asset.generator = "lfd-scene";
  }

  Status add_all() {
    for (const proto::Material& material : data_.scene.material()) LFD_TRY_STATUS(add_material(material));
    for (const proto::Instance& instance : data_.scene.instance()) LFD_TRY_STATUS(add_instance(instance));
    for (const proto::Light& light : data_.scene.light()) add_light(light);
    return {};
  }

  Status write(const std::filesystem::path& path) {
    std::ostringstream stream;
    tinygltf::TinyGLTF writer;
    if (!writer.WriteGltfSceneToStream(&model_, stream, false, true)) return Error("tinygltf cannot write the scene");
    return write_file(path, std::move(stream).str());
  }

 private:
  Result<const std::string*> asset(const std::string& hash) const {
    const auto found = data_.assets.find(hash);
    if (found == data_.assets.end()) return Error(fmt::format("asset {} is missing", hash));
    return found->second.get();
  }

  int add_view(const void* bytes, std::size_t size, int target) {
    std::vector<unsigned char>& buffer = model_.buffers.front().data;
    buffer.resize((buffer.size() + 3) / 4 * 4);  // glTF: accessors are aligned to their components
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = buffer.size();
    view.byteLength = size;
    view.target = target;
    const auto* first = static_cast<const unsigned char*>(bytes);
    buffer.insert(buffer.end(), first, first + size);
    model_.bufferViews.push_back(std::move(view));
    return static_cast<int>(model_.bufferViews.size() - 1);
  }

  template <class T>
  int add_accessor(const std::vector<T>& values, int component_type, int type, int target) {
    tinygltf::Accessor accessor;
    accessor.bufferView = add_view(values.data(), values.size() * sizeof(T), target);
    accessor.componentType = component_type;
    accessor.type = type;
    accessor.count = values.size();
    model_.accessors.push_back(std::move(accessor));
    return static_cast<int>(model_.accessors.size() - 1);
  }

  template <class T>
  int add_attribute(const std::vector<T>& values, int type) {
    return add_accessor(values, TINYGLTF_COMPONENT_TYPE_FLOAT, type, TINYGLTF_TARGET_ARRAY_BUFFER);
  }

  // glTF asks for the bounds of positions.
  void set_bounds(const std::vector<glm::vec3>& positions, tinygltf::Accessor& accessor) {
    accessor.minValues.assign(3, std::numeric_limits<double>::infinity());
    accessor.maxValues.assign(3, -std::numeric_limits<double>::infinity());
    for (const glm::vec3& p : positions) {
      for (int axis = 0; axis < 3; ++axis) {
        auto& low = accessor.minValues[static_cast<std::size_t>(axis)];
        auto& high = accessor.maxValues[static_cast<std::size_t>(axis)];
        low = std::min(low, static_cast<double>(p[axis]));
        high = std::max(high, static_cast<double>(p[axis]));
      }
    }
  }

  void use_extension(const std::string& name) {
    if (std::ranges::find(model_.extensionsUsed, name) == model_.extensionsUsed.end()) {
      model_.extensionsUsed.push_back(name);
    }
  }

  Status add_material(const proto::Material& from) {
    tinygltf::Material material;
    material.name = from.name();
    material.pbrMetallicRoughness.baseColorFactor.assign(from.base_color().begin(), from.base_color().end());
    material.pbrMetallicRoughness.metallicFactor = 0;
    material.doubleSided = from.double_sided();
    if (from.has_alpha_cutoff()) {
      material.alphaMode = "MASK";
      material.alphaCutoff = from.alpha_cutoff();
    }
    if (from.unlit()) {
      material.extensions["KHR_materials_unlit"] = tinygltf::Value(tinygltf::Value::Object());
      use_extension("KHR_materials_unlit");
    }
    if (from.has_texture()) {
      LFD_TRY(material.pbrMetallicRoughness.baseColorTexture.index, add_texture(from.texture()));
    }
    model_.materials.push_back(std::move(material));
    return {};
  }

  static int wrap_of(proto::Texture::Wrap wrap) {
    if (wrap == proto::Texture::CLAMP_TO_EDGE) return TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    if (wrap == proto::Texture::MIRRORED_REPEAT) return TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT;
    return TINYGLTF_TEXTURE_WRAP_REPEAT;
  }

  Result<int> add_texture(const proto::Texture& from) {
    if (from.uv_transform_size() != 0) return Error("textures with a transform are not written");
    tinygltf::Sampler sampler;
    sampler.wrapS = wrap_of(from.wrap_s());
    sampler.wrapT = wrap_of(from.wrap_t());
    sampler.magFilter = from.nearest() ? TINYGLTF_TEXTURE_FILTER_NEAREST : TINYGLTF_TEXTURE_FILTER_LINEAR;
    model_.samplers.push_back(sampler);
    LFD_TRY(const int image, add_image(from.picture()));
    tinygltf::Texture texture;
    texture.sampler = static_cast<int>(model_.samplers.size() - 1);
    texture.source = image;
    model_.textures.push_back(texture);
    return static_cast<int>(model_.textures.size() - 1);
  }

  Result<int> add_image(const std::string& hash) {
    if (const auto known = images_.find(hash); known != images_.end()) return known->second;
    LFD_TRY(const std::string* bytes, asset(hash));
    proto::Picture picture;
    if (!picture.ParseFromString(*bytes)) return Error(fmt::format("picture {} cannot be parsed", hash));
    tinygltf::Image image;
    image.bufferView = add_view(picture.file().data(), picture.file().size(), 0);
    image.mimeType = picture.file().starts_with("\x89PNG") ? "image/png" : "image/jpeg";
    model_.images.push_back(std::move(image));
    return images_[hash] = static_cast<int>(model_.images.size() - 1);
  }

  // `mirrored`: the instance's transform turns triangles over, so the file's mesh has the other winding.
  Result<int> add_mesh(const std::string& hash, std::uint32_t material, bool mirrored) {
    const auto key = std::tuple(hash, material, mirrored);
    if (const auto known = meshes_.find(key); known != meshes_.end()) return known->second;
    LFD_TRY(const std::string* bytes, asset(hash));
    LFD_TRY(MeshArrays arrays, mesh_arrays(*bytes));
    if (mirrored) swap_winding(arrays);
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = static_cast<int>(material);
    primitive.attributes["POSITION"] = add_attribute(arrays.position, TINYGLTF_TYPE_VEC3);
    set_bounds(arrays.position, model_.accessors.back());
    primitive.attributes["NORMAL"] = add_attribute(arrays.normal, TINYGLTF_TYPE_VEC3);
    if (!arrays.uv.empty()) primitive.attributes["TEXCOORD_0"] = add_attribute(arrays.uv, TINYGLTF_TYPE_VEC2);
    if (!arrays.color.empty()) primitive.attributes["COLOR_0"] = add_attribute(arrays.color, TINYGLTF_TYPE_VEC4);
    primitive.indices = add_accessor(arrays.index, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR,
                                     TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    model_.meshes.emplace_back().primitives.push_back(std::move(primitive));
    return meshes_[key] = static_cast<int>(model_.meshes.size() - 1);
  }

  void add_node(tinygltf::Node node) {
    model_.scenes.front().nodes.push_back(static_cast<int>(model_.nodes.size()));
    model_.nodes.push_back(std::move(node));
  }

  Status add_instance(const proto::Instance& instance) {
    const glm::dmat4 world_from_mesh = matrix_of(instance);
    tinygltf::Node node;
    LFD_TRY(node.mesh, add_mesh(instance.mesh(), instance.material(), mirrors(world_from_mesh)));
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 4; ++row) node.matrix.push_back(world_from_mesh[column][row]);
    }
    add_node(std::move(node));
    return {};
  }

  // A light shines along its node's -z.
  static std::vector<double> rotation_to(const proto::Vector& direction) {
    const glm::dvec3 to(direction.x(), direction.y(), direction.z());
    const double half = 1 - to.z;  // 1 + cosine of the angle between (0, 0, -1) and `to`
    if (half < 1e-9) return {1, 0, 0, 0};
    const glm::dvec4 q(to.y, -to.x, 0, half);
    const double length = glm::length(q);
    return {q.x / length, q.y / length, q.z / length, q.w / length};
  }

  void add_light(const proto::Light& from) {
    if (from.kind() == proto::Light::AMBIENT || from.kind() == proto::Light::HEAD) return;
    tinygltf::Light light;
    const double brightest = std::max({from.color(0), from.color(1), from.color(2), 1e-9F});
    for (const float channel : from.color()) light.color.push_back(channel / brightest);
    light.intensity = brightest * std::numbers::pi;
    light.range = from.range_m();
    tinygltf::Node node;
    if (from.kind() == proto::Light::DIRECTIONAL) light.type = "directional";
    if (from.kind() == proto::Light::POINT) light.type = "point";
    if (from.kind() == proto::Light::SPOT) {
      light.type = "spot";
      light.spot.innerConeAngle = from.inner_cone_rad();
      light.spot.outerConeAngle = from.outer_cone_rad();
    }
    if (from.has_position()) node.translation = {from.position().x(), from.position().y(), from.position().z()};
    if (from.has_direction()) node.rotation = rotation_to(from.direction());
    tinygltf::Value::Object extension;
    extension["light"] = tinygltf::Value(static_cast<int>(model_.lights.size()));
    node.extensions["KHR_lights_punctual"] = tinygltf::Value(std::move(extension));
    use_extension("KHR_lights_punctual");
    model_.lights.push_back(std::move(light));
    add_node(std::move(node));
  }

  const SceneData& data_;
  tinygltf::Model model_;
  std::map<std::string, int> images_;                                   // by hash of the picture
  std::map<std::tuple<std::string, std::uint32_t, bool>, int> meshes_;  // by hash, material, mirrored
};

}  // namespace

Status write_glb(const std::filesystem::path& path, const SceneData& data) {
  Writer writer(data);
  LFD_TRY_STATUS(writer.add_all());
  return writer.write(path);
}

}  // namespace lfd::scene
