// A primitive of a glTF mesh as triangles.
#pragma once

#include <tiny_gltf.h>

#include "base/result.h"
#include "proto/mesh_arrays.h"

namespace lfd::scene::gltf {

// True for the modes that are triangles; points and lines are not drawn.
bool has_triangles(const tinygltf::Primitive& primitive);

// Vertices and indices that the primitive claims to have, without reading them.
struct Size {
  std::size_t vertices = 0;
  std::size_t indices = 0;
};
Size claimed_size(const tinygltf::Model& model, const tinygltf::Primitive& primitive);

// Reads a primitive that has_triangles. uv is that of set `uv_set`; empty if the primitive lacks it or the set is
// negative. Missing normals are flat, as glTF 2.0 asks (section 3.7.2.1). Positions are finite; `mended` is raised by
// how many texture coordinates and colours are not, for which 0 is taken.
Result<MeshArrays> read_primitive(const tinygltf::Model& model, const tinygltf::Primitive& primitive, int uv_set,
                                  std::size_t& mended);

}  // namespace lfd::scene::gltf
