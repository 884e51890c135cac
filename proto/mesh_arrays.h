// The arrays of a mesh asset, copied out and checked, so that whoever uses them can trust every index.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "proto/scene.pb.h"

namespace lfd {

// Triangles of one mesh, in its own space. normal has one entry per vertex; uv and color have one each or are empty.
struct MeshArrays {
  std::vector<glm::vec3> position;
  std::vector<glm::vec3> normal;
  std::vector<glm::vec2> uv;
  std::vector<glm::vec4> color;
  std::vector<std::uint32_t> index;  // three per triangle, each below position.size()
};

// Refuses arrays of odd or disagreeing lengths and indices out of range.
Result<MeshArrays> mesh_arrays(const proto::Mesh& mesh);

// The same from a serialised asset.
Result<MeshArrays> mesh_arrays(std::string_view asset);

proto::Mesh mesh_message(const MeshArrays& arrays);

}  // namespace lfd
