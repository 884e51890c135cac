// Where nodes stand in the world.
#include "controller/scene/node_tree.h"

namespace lfd::scene {

glm::dmat4 Placement::parent_from_node() const {
  if (matrix) return *matrix;
  glm::dmat4 result = glm::mat4_cast(rotation);
  for (int axis = 0; axis < 3; ++axis) result[axis] *= scale[axis];
  result[3] = glm::dvec4(translation, 1.0);
  return result;
}

std::vector<glm::dmat4> world_from_nodes(const NodeTree& tree) {
  std::vector<glm::dmat4> result;
  result.reserve(tree.size());
  for (const Node& node : tree) {
    const glm::dmat4 parent_from_node = node.placement.parent_from_node();
    result.push_back(node.parent < 0 ? parent_from_node
                                     : result[static_cast<std::size_t>(node.parent)] * parent_from_node);
  }
  return result;
}

}  // namespace lfd::scene
