// Small changes of triangle arrays.
#include "controller/scene/mesh_tools.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace lfd::scene {
namespace {

// In double: the squared length of a float normal may underflow.
bool normalise(glm::vec3& normal) {
  const glm::dvec3 wide(normal);
  const double length = glm::length(wide);
  if (!(length > 0) || !std::isfinite(length)) return false;
  normal = glm::vec3(wide / length);
  return true;
}

}  // namespace

glm::vec3 face_normal(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
  const glm::dvec3 cross = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
  const double length = glm::length(cross);
  return length > 0 && std::isfinite(length) ? glm::vec3(cross / length) : glm::vec3(0, 0, 1);
}

MeshArrays with_flat_normals(const MeshArrays& arrays) {
  MeshArrays flat;
  const std::size_t corners = arrays.index.size();
  flat.position.reserve(corners);
  flat.normal.reserve(corners);
  flat.index.reserve(corners);
  for (std::size_t i = 0; i < corners; ++i) {
    const std::uint32_t from = arrays.index[i];
    flat.position.push_back(arrays.position[from]);
    if (!arrays.uv.empty()) flat.uv.push_back(arrays.uv[from]);
    if (!arrays.color.empty()) flat.color.push_back(arrays.color[from]);
    flat.index.push_back(static_cast<std::uint32_t>(i));
  }
  for (std::size_t i = 0; i < corners; i += 3) {
    flat.normal.insert(flat.normal.end(), 3, face_normal(flat.position[i], flat.position[i + 1], flat.position[i + 2]));
  }
  return flat;
}

void mend_normals(MeshArrays& arrays) {
  std::vector<bool> broken(arrays.normal.size(), false);
  bool any_broken = false;
  for (std::size_t i = 0; i < arrays.normal.size(); ++i) {
    if (normalise(arrays.normal[i])) continue;
    broken[i] = any_broken = true;
    arrays.normal[i] = glm::vec3(0, 0, 1);
  }
  if (!any_broken) return;
  for (std::size_t i = 0; i < arrays.index.size(); i += 3) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = arrays.index[i + corner];
      if (!broken[vertex]) continue;
      const auto at = [&](std::size_t k) { return arrays.position[arrays.index[i + k]]; };
      arrays.normal[vertex] = face_normal(at(0), at(1), at(2));
    }
  }
}

void swap_winding(MeshArrays& arrays) {
  for (std::size_t i = 0; i < arrays.index.size(); i += 3) std::swap(arrays.index[i + 1], arrays.index[i + 2]);
}

}  // namespace lfd::scene
