// Materials, and their pictures gathered into array textures.
#include <algorithm>
#include <array>
#include <bit>
#include <tuple>

#include "base/log.h"
#include "proto/pictures/decode.h"
#include "rendernode/passes/gpu_scene.h"

namespace lfd {
namespace {

// Everything that pictures of one array texture must share.
using GroupKey = std::tuple<int, int, int, int, bool>;  // width, height, wrap_s, wrap_t, nearest

struct Gathered {
  std::vector<const Picture8*> layers;
  std::map<std::string, int> layer_of;  // by picture hash
  int group = 0;
};

GLint wrap_mode(proto::Texture::Wrap wrap) {
  switch (wrap) {
    case proto::Texture::CLAMP_TO_EDGE:
      return GL_CLAMP_TO_EDGE;
    case proto::Texture::MIRRORED_REPEAT:
      return GL_MIRRORED_REPEAT;
    default:
      return GL_REPEAT;
  }
}

TextureGroup make_group(const GroupKey& key, const std::vector<const Picture8*>& layers) {
  const auto& [width, height, wrap_s, wrap_t, nearest] = key;
  const int levels = std::bit_width(static_cast<unsigned>(std::max(width, height)));
  TextureGroup group{gl::make_array_texture(GL_SRGB8_ALPHA8, {width, height}, static_cast<int>(layers.size()), levels),
                     {}};
  for (std::size_t layer = 0; layer < layers.size(); ++layer) {
    glTextureSubImage3D(group.texture.name(), 0, 0, 0, static_cast<GLint>(layer), width, height, 1, GL_RGBA,
                        GL_UNSIGNED_BYTE, layers[layer]->rgba.data());
  }
  glGenerateTextureMipmap(group.texture.name());
  GLuint sampler = 0;
  glCreateSamplers(1, &sampler);
  group.sampler = gl::Sampler(sampler);
  glSamplerParameteri(sampler, GL_TEXTURE_WRAP_S, wrap_mode(static_cast<proto::Texture::Wrap>(wrap_s)));
  glSamplerParameteri(sampler, GL_TEXTURE_WRAP_T, wrap_mode(static_cast<proto::Texture::Wrap>(wrap_t)));
  glSamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glSamplerParameteri(sampler, GL_TEXTURE_MAG_FILTER, nearest ? GL_NEAREST : GL_LINEAR);
  return group;
}

class Gatherer {
 public:
  explicit Gatherer(const Assets& assets) : assets_(assets) {}

  // Group and layer of a texture; decodes its picture once.
  Result<std::pair<int, int>> place(const proto::Texture& texture) {
    LFD_TRY(const Picture8* picture, decoded(texture.picture()));
    const GroupKey key{picture->width, picture->height, texture.wrap_s(), texture.wrap_t(), texture.nearest()};
    const auto [entry, added] = groups_.try_emplace(key);
    if (added) entry->second.group = static_cast<int>(groups_.size()) - 1;
    Gathered& gathered = entry->second;
    const auto [layer, fresh] =
        gathered.layer_of.try_emplace(texture.picture(), static_cast<int>(gathered.layers.size()));
    if (fresh) gathered.layers.push_back(picture);
    return std::pair(gathered.group, layer->second);
  }

  std::vector<TextureGroup> upload() const {
    std::vector<TextureGroup> groups(groups_.size());
    for (const auto& [key, gathered] : groups_)
      groups[static_cast<std::size_t>(gathered.group)] = make_group(key, gathered.layers);
    return groups;
  }

 private:
  Result<const Picture8*> decoded(const std::string& hash) {
    if (const auto known = pictures_.find(hash); known != pictures_.end()) return &known->second;
    const auto asset = assets_.find(hash);
    if (asset == assets_.end()) return Error(fmt::format("picture {} is missing", hash));
    proto::Picture message;
    if (!message.ParseFromString(*asset->second)) return Error(fmt::format("picture {} cannot be parsed", hash));
    LFD_TRY(Picture8 picture, decode_picture(message.file()));
    return &pictures_.emplace(hash, std::move(picture)).first->second;
  }

  const Assets& assets_;
  std::map<std::string, Picture8> pictures_;
  std::map<GroupKey, Gathered> groups_;
};

shared::MaterialParams params_of(const proto::Material& material, int layer) {
  shared::MaterialParams params{};
  for (int i = 0; i < 4; ++i) params.base_color[i] = i < material.base_color_size() ? material.base_color(i) : 1.0F;
  const bool transformed = material.texture().uv_transform_size() == 6;
  const std::array<float, 6> identity{1, 0, 0, 0, 1, 0};
  const auto entry = [&](int i) {
    return transformed ? material.texture().uv_transform(i) : identity[static_cast<std::size_t>(i)];
  };
  params.uv_transform_0 = {entry(0), entry(1), entry(2), static_cast<float>(layer)};
  params.uv_transform_1 = {entry(3), entry(4), entry(5), 0};
  params.alpha = {material.has_alpha_cutoff() ? material.alpha_cutoff() : -1.0F, 0, 0, 0};
  return params;
}

}  // namespace

Result<GpuMaterials> upload_materials(const proto::Scene& scene, const Assets& assets, bool unlit) {
  GpuMaterials gpu;
  Gatherer gatherer(assets);
  std::vector<shared::MaterialParams> params;
  for (int i = 0; i < scene.material_size(); ++i) {
    const auto& material = scene.material(i);
    std::pair<int, int> place{-1, -1};
    if (material.has_texture()) {
      auto found = gatherer.place(material.texture());
      if (!found) return found.error().within(fmt::format("material {} \"{}\"", i, material.name()));
      place = *found;
    }
    params.push_back(params_of(material, place.second));
    gpu.facts.push_back({place.first, material.has_alpha_cutoff(), unlit || material.unlit(), material.double_sided()});
  }
  gpu.params = gl::make_buffer(params);
  gpu.groups = gatherer.upload();
  return gpu;
}

}  // namespace lfd
