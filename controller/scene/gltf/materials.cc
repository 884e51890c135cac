// Materials of a glTF file.
#include "controller/scene/gltf/materials.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/log.h"
#include "controller/scene/gltf/accessors.h"
#include "controller/scene/limits.h"
#include "proto/pictures/decode.h"

namespace lfd::scene::gltf {
namespace {

constexpr int kNearest = 9728;  // GL_NEAREST, as samplers write it

// The encoded bytes of an image, known to decode: a picture that a node could not read is refused here, by name.
Result<std::string> picture_of(const Document& document, const tinygltf::Image& image) {
  std::string bytes(image.image.begin(), image.image.end());
  if (image.bufferView >= 0) {
    LFD_TRY(const std::span<const unsigned char> view, bytes_of_view(document.model, image.bufferView));
    bytes.assign(view.begin(), view.end());
  } else if (bytes.empty()) {
    for (const auto& [name, reason] : document.refused) {
      if (name == image.uri) return Error(reason).within(fmt::format("\"{}\"", name));
    }
    return Error(fmt::format("\"{}\": cannot be read", image.uri.substr(0, 100)));
  }
  if (bytes.size() > kMaxPictureBytes)
    return Error(fmt::format("{} bytes; at most {} are read", bytes.size(), kMaxPictureBytes));
  if (const auto decoded = decode_picture(bytes); !decoded) return decoded.error();
  return bytes;
}

proto::Texture::Wrap wrap_of(int mode) {
  if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return proto::Texture::CLAMP_TO_EDGE;
  if (mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return proto::Texture::MIRRORED_REPEAT;
  return proto::Texture::REPEAT;
}

double number_at(const tinygltf::Value& array, int i, double otherwise) {
  if (!array.IsArray() || static_cast<std::size_t>(i) >= array.ArrayLen()) return otherwise;
  const tinygltf::Value& item = array.Get(i);
  return item.IsNumber() ? item.GetNumberAsDouble() : otherwise;
}

// KHR_texture_transform: offset * rotation * scale; the rotation is counter-clockwise as one sees it, with v pointing
// down.
void set_uv_transform(const tinygltf::Value& extension, proto::Texture& texture) {
  const tinygltf::Value& offset = extension.Get("offset");
  const tinygltf::Value& scale = extension.Get("scale");
  const tinygltf::Value& rotation = extension.Get("rotation");
  const double angle = rotation.IsNumber() ? rotation.GetNumberAsDouble() : 0.0;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const double su = number_at(scale, 0, 1.0);
  const double sv = number_at(scale, 1, 1.0);
  for (const double value : {c * su, s * sv, number_at(offset, 0, 0.0), -s * su, c * sv, number_at(offset, 1, 0.0)}) {
    texture.add_uv_transform(static_cast<float>(value));
  }
}

// Reads materials one after the other; a picture that several use is added once.
class Reader {
 public:
  Reader(const Document& document, SceneBuilder& scene, std::vector<std::string>& warnings)
      : document_(document), model_(document.model), scene_(scene), warnings_(warnings) {}

  Result<ReadMaterial> read(const tinygltf::Material& from, const std::string& place) {
    proto::Material material;
    material.set_name(from.name);
    LFD_TRY_STATUS(read_base_color(from, material));
    if (from.alphaMode == "MASK") material.set_alpha_cutoff(static_cast<float>(from.alphaCutoff));
    material.set_double_sided(from.doubleSided);
    material.set_unlit(from.extensions.contains("KHR_materials_unlit"));
    ReadMaterial result;
    const tinygltf::TextureInfo& info = from.pbrMetallicRoughness.baseColorTexture;
    if (info.index >= 0) {
      Result<std::optional<proto::Texture>> texture = read_texture(info, place);
      if (!texture) return texture.error().within("baseColorTexture");
      if (*texture) {
        *material.mutable_texture() = **std::move(texture);
        result.uv_set = uv_set_of(info);
      }
    }
    result.index = scene_.add_material(std::move(material));
    return result;
  }

 private:
  static Status read_base_color(const tinygltf::Material& from, proto::Material& material) {
    const std::vector<double>& factor = from.pbrMetallicRoughness.baseColorFactor;
    if (factor.size() != 4) return Error(fmt::format("baseColorFactor: {} numbers; 4 are needed", factor.size()));
    for (const double value : factor) material.add_base_color(static_cast<float>(value));
    return {};
  }

  static int uv_set_of(const tinygltf::TextureInfo& info) {
    const auto transform = info.extensions.find("KHR_texture_transform");
    if (transform == info.extensions.end() || !transform->second.IsObject()) return info.texCoord;
    const tinygltf::Value& over = transform->second.Get("texCoord");
    return over.IsInt() ? over.GetNumberAsInt() : info.texCoord;
  }

  // Absent where the file gives the texture no image that this driver can read.
  Result<std::optional<proto::Texture>> read_texture(const tinygltf::TextureInfo& info, const std::string& place) {
    LFD_TRY(const tinygltf::Texture* from, item_at(model_.textures, info.index, "texture"));
    if (from->source < 0) {
      warnings_.push_back(fmt::format("{}: texture {} has no PNG or JPEG image; drawn without", place, info.index));
      return std::optional<proto::Texture>();
    }
    proto::Texture texture;
    Result<std::string> picture = add_picture(from->source);
    if (!picture) return picture.error().within(fmt::format("texture {}", info.index));
    texture.set_picture(*std::move(picture));
    if (from->sampler >= 0) {
      LFD_TRY(const tinygltf::Sampler* sampler, item_at(model_.samplers, from->sampler, "sampler"));
      texture.set_wrap_s(wrap_of(sampler->wrapS));
      texture.set_wrap_t(wrap_of(sampler->wrapT));
      texture.set_nearest(sampler->magFilter == kNearest);
    }
    const auto transform = info.extensions.find("KHR_texture_transform");
    if (transform != info.extensions.end() && transform->second.IsObject())
      set_uv_transform(transform->second, texture);
    return std::optional<proto::Texture>(std::move(texture));
  }

  Result<std::string> add_picture(int source) {
    if (const auto known = pictures_.find(source); known != pictures_.end()) return known->second;
    LFD_TRY(const tinygltf::Image* image, item_at(model_.images, source, "image"));
    Result<std::string> bytes = picture_of(document_, *image);
    if (!bytes) return bytes.error().within(label("image", static_cast<std::size_t>(source), image->name));
    return pictures_[source] = scene_.add_picture(*std::move(bytes));
  }

  const Document& document_;
  const tinygltf::Model& model_;
  SceneBuilder& scene_;
  std::vector<std::string>& warnings_;
  std::map<int, std::string> pictures_;  // content hash by image
};

bool needs_default(const tinygltf::Model& model) {
  return std::ranges::any_of(model.meshes, [](const tinygltf::Mesh& mesh) {
    return std::ranges::any_of(mesh.primitives, [](const tinygltf::Primitive& p) { return p.material == -1; });
  });
}

}  // namespace

Result<std::vector<ReadMaterial>> read_materials(const Document& document, SceneBuilder& scene,
                                                 std::vector<std::string>& warnings) {
  Reader reader(document, scene, warnings);
  std::vector<ReadMaterial> result;
  for (std::size_t i = 0; i < document.model.materials.size(); ++i) {
    const tinygltf::Material& from = document.model.materials[i];
    const std::string place = label("material", i, from.name);
    Result<ReadMaterial> material = reader.read(from, place);
    if (!material) return material.error().within(place);
    result.push_back(*material);
  }
  if (needs_default(document.model)) {
    LFD_TRY(const ReadMaterial standard, reader.read(tinygltf::Material(), "default material"));
    result.push_back(standard);
  }
  return result;
}

}  // namespace lfd::scene::gltf
