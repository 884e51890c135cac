// Accessors of a primitive to triangle arrays.
#include "controller/scene/gltf/primitives.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "base/log.h"
#include "controller/scene/gltf/accessors.h"
#include "controller/scene/mesh_tools.h"

namespace lfd::scene::gltf {
namespace {

template <class Vector>
std::vector<Vector> as_vectors(const std::vector<float>& floats) {
  std::vector<Vector> result(floats.size() * sizeof(float) / sizeof(Vector));
  if (!floats.empty()) std::memcpy(result.data(), floats.data(), floats.size() * sizeof(float));
  return result;
}

// The accessor of an attribute, -1 if the primitive has none.
int attribute(const tinygltf::Primitive& primitive, const std::string& name) {
  const auto found = primitive.attributes.find(name);
  return found == primitive.attributes.end() ? -1 : found->second;
}

Result<std::vector<glm::vec3>> read_positions(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
  if (!primitive.attributes.contains("POSITION")) return Error("POSITION is missing");
  const Result<std::vector<float>> floats = read_floats(model, attribute(primitive, "POSITION"), 3);
  if (!floats) return floats.error().within("POSITION");
  const auto broken = std::ranges::find_if(*floats, [](float value) { return !std::isfinite(value); });
  if (broken != floats->end()) {
    return Error(fmt::format("POSITION: accessor {}: vertex {} is not finite", attribute(primitive, "POSITION"),
                             (broken - floats->begin()) / 3));
  }
  return as_vectors<glm::vec3>(*floats);
}

// Reads an attribute that may be absent; `read` gets the accessor.
template <class Vector, class Read>
Status read_optional(const tinygltf::Primitive& primitive, const std::string& name, std::size_t vertices,
                     std::vector<Vector>& to, Read read) {
  if (!primitive.attributes.contains(name)) return {};
  const Result<std::vector<float>> floats = read(attribute(primitive, name));
  if (!floats) return floats.error().within(name);
  to = as_vectors<Vector>(*floats);
  if (to.size() != vertices) return Error(fmt::format("{}: {} values for {} vertices", name, to.size(), vertices));
  return {};
}

template <class Vector>
std::size_t zero_where_not_finite(std::vector<Vector>& values) {
  std::size_t mended = 0;
  for (Vector& value : values) {
    for (int c = 0; c < Vector::length(); ++c) {
      if (std::isfinite(value[c])) continue;
      value[c] = 0;
      ++mended;
    }
  }
  return mended;
}

Result<std::vector<std::uint32_t>> read_or_count(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                                 std::size_t vertices) {
  if (primitive.indices < 0) {
    std::vector<std::uint32_t> all(vertices);
    std::iota(all.begin(), all.end(), 0U);
    return all;
  }
  Result<std::vector<std::uint32_t>> indices = read_indices(model, primitive.indices);
  if (!indices) return indices.error().within("indices");
  const auto outside = std::ranges::find_if(*indices, [&](std::uint32_t i) { return i >= vertices; });
  if (outside != indices->end()) {
    return Error(fmt::format("indices: accessor {}: index {} of {} vertices", primitive.indices, *outside, vertices));
  }
  return indices;
}

// Strips and fans to separate triangles, each with the winding that glTF 2.0 (section 3.7.2.1) gives it.
std::vector<std::uint32_t> triangles(const std::vector<std::uint32_t>& from, int mode) {
  std::vector<std::uint32_t> result;
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    result = from;
    result.resize(from.size() - from.size() % 3);  // glTF: vertices beyond whole triangles are not drawn
    return result;
  }
  for (std::size_t i = 2; i < from.size(); ++i) {
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
      result.insert(result.end(), {from[i - 1], from[i], from[0]});
    } else if (i % 2 == 0) {
      result.insert(result.end(), {from[i - 2], from[i - 1], from[i]});
    } else {
      result.insert(result.end(), {from[i - 2], from[i], from[i - 1]});
    }
  }
  return result;
}

}  // namespace

bool has_triangles(const tinygltf::Primitive& primitive) {
  return primitive.mode >= TINYGLTF_MODE_TRIANGLES && primitive.mode <= TINYGLTF_MODE_TRIANGLE_FAN;
}

Size claimed_size(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
  const auto count = [&](int accessor) {
    const bool exists = accessor >= 0 && static_cast<std::size_t>(accessor) < model.accessors.size();
    return exists ? model.accessors[static_cast<std::size_t>(accessor)].count : 0;
  };
  Size size;
  size.vertices = count(attribute(primitive, "POSITION"));
  size.indices = primitive.indices >= 0 ? count(primitive.indices) : size.vertices;
  if (attribute(primitive, "NORMAL") < 0) size.vertices = std::max(size.vertices, size.indices);  // flat: own vertices
  return size;
}

Result<MeshArrays> read_primitive(const tinygltf::Model& model, const tinygltf::Primitive& primitive, int uv_set,
                                  std::size_t& mended) {
  MeshArrays arrays;
  LFD_TRY(arrays.position, read_positions(model, primitive));
  const std::size_t vertices = arrays.position.size();
  const auto floats = [&](int components) {
    return [&model, components](int accessor) { return read_floats(model, accessor, components); };
  };
  LFD_TRY_STATUS(read_optional(primitive, "NORMAL", vertices, arrays.normal, floats(3)));
  if (uv_set >= 0) {
    LFD_TRY_STATUS(read_optional(primitive, fmt::format("TEXCOORD_{}", uv_set), vertices, arrays.uv, floats(2)));
  }
  LFD_TRY_STATUS(read_optional(primitive, "COLOR_0", vertices, arrays.color,
                               [&](int accessor) { return read_colors(model, accessor, 1.0F); }));
  mended += zero_where_not_finite(arrays.uv) + zero_where_not_finite(arrays.color);
  LFD_TRY(const std::vector<std::uint32_t> listed, read_or_count(model, primitive, vertices));
  arrays.index = triangles(listed, primitive.mode);
  if (arrays.normal.empty()) return with_flat_normals(arrays);
  mend_normals(arrays);
  return arrays;
}

}  // namespace lfd::scene::gltf
