// Bytes of mesh assets to arrays and back.
#include "proto/mesh_arrays.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

#include "base/log.h"

namespace lfd {
namespace {

static_assert(std::endian::native == std::endian::little, "mesh assets are little-endian");

template <class T>
Status copy_out(const char* name, const std::string& bytes, std::vector<T>& to) {
  if (bytes.size() % sizeof(T) != 0) {
    return Error(fmt::format("mesh: {}: {} bytes are no multiple of {}", name, bytes.size(), sizeof(T)));
  }
  to.resize(bytes.size() / sizeof(T));
  if (!bytes.empty()) std::memcpy(to.data(), bytes.data(), bytes.size());
  return {};
}

template <class T>
std::string copy_in(const std::vector<T>& from) {
  return std::string(reinterpret_cast<const char*>(from.data()), from.size() * sizeof(T));
}

Status check_length(const char* name, std::size_t length, std::size_t vertices, bool optional) {
  if (length == vertices || (optional && length == 0)) return {};
  return Error(fmt::format("mesh: {}: {} entries for {} vertices", name, length, vertices));
}

}  // namespace

Result<MeshArrays> mesh_arrays(const proto::Mesh& mesh) {
  MeshArrays arrays;
  LFD_TRY_STATUS(copy_out("position", mesh.position(), arrays.position));
  LFD_TRY_STATUS(copy_out("normal", mesh.normal(), arrays.normal));
  LFD_TRY_STATUS(copy_out("uv", mesh.uv(), arrays.uv));
  LFD_TRY_STATUS(copy_out("color", mesh.color(), arrays.color));
  LFD_TRY_STATUS(copy_out("index", mesh.index(), arrays.index));
  const std::size_t vertices = arrays.position.size();
  LFD_TRY_STATUS(check_length("normal", arrays.normal.size(), vertices, false));
  LFD_TRY_STATUS(check_length("uv", arrays.uv.size(), vertices, true));
  LFD_TRY_STATUS(check_length("color", arrays.color.size(), vertices, true));
  if (arrays.index.size() % 3 != 0)
    return Error(fmt::format("mesh: index: {} is no multiple of 3", arrays.index.size()));
  const auto outside = std::ranges::find_if(arrays.index, [&](std::uint32_t i) { return i >= vertices; });
  if (outside != arrays.index.end()) return Error(fmt::format("mesh: index: {} of {} vertices", *outside, vertices));
  return arrays;
}

Result<MeshArrays> mesh_arrays(std::string_view asset) {
  proto::Mesh mesh;
  if (!mesh.ParseFromArray(asset.data(), static_cast<int>(asset.size())))
    return Error("mesh: the asset cannot be parsed");
  return mesh_arrays(mesh);
}

proto::Mesh mesh_message(const MeshArrays& arrays) {
  proto::Mesh mesh;
  mesh.set_position(copy_in(arrays.position));
  mesh.set_normal(copy_in(arrays.normal));
  mesh.set_uv(copy_in(arrays.uv));
  mesh.set_color(copy_in(arrays.color));
  mesh.set_index(copy_in(arrays.index));
  return mesh;
}

}  // namespace lfd
