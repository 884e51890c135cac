// The nodes of a glTF scene as a tree: cycles, shared children and wild transforms are refused.
#pragma once

#include <tiny_gltf.h>

#include <vector>

#include "base/result.h"
#include "controller/scene/node_tree.h"

namespace lfd::scene::gltf {

struct ReadNodes {
  NodeTree tree;                        // the nodes that the scene reaches, parents first
  std::vector<std::size_t> model_node;  // by tree node: index in the model
  std::vector<int> tree_node;           // by model node: index in the tree, -1: not in the scene
};

// The default scene of the model, else its first; a model without scenes: all nodes that are no one's children.
Result<ReadNodes> read_nodes(const tinygltf::Model& model);

}  // namespace lfd::scene::gltf
