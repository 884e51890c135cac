// The hierarchy of a scene's nodes, and where each stands in the world.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace lfd::scene {

// parent_from_node: either a matrix as given, or translation * rotation * scale.
struct Placement {
  glm::dvec3 translation{0.0};
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  // unit; w first
  glm::dvec3 scale{1.0};
  std::optional<glm::dmat4> matrix;  // present: the three above are not used

  glm::dmat4 parent_from_node() const;
};

struct Node {
  int parent = -1;  // index in the tree, less than the node's own; -1: a root
  Placement placement;
};

// Parents stand before their children.
using NodeTree = std::vector<Node>;

// world_from_node of every node.
std::vector<glm::dmat4> world_from_nodes(const NodeTree& tree);

}  // namespace lfd::scene
