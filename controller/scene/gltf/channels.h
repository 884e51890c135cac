// Animation channels of a glTF file.
#pragma once

#include <tiny_gltf.h>

#include <vector>

#include "base/result.h"
#include "controller/scene/animations.h"

namespace lfd::scene::gltf {

// The channels of all animations that move nodes of the tree; they play together. `tree_node` is ReadNodes::tree_node.
// Of several channels for one property of one node the last counts.
Result<std::vector<Channel>> read_channels(const tinygltf::Model& model, const NodeTree& tree,
                                           const std::vector<int>& tree_node);

}  // namespace lfd::scene::gltf
