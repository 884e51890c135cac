// The nodes of a glTF scene.
#include "controller/scene/gltf/nodes.h"

#include <cmath>
#include <glm/gtc/type_ptr.hpp>

#include "base/log.h"
#include "controller/scene/gltf/document.h"

namespace lfd::scene::gltf {
namespace {

std::string label_of(const tinygltf::Model& model, std::size_t node) {
  return label("node", node, model.nodes[node].name);
}

Status check_numbers(const std::vector<double>& numbers, std::size_t wanted, const char* name) {
  if (numbers.size() != wanted)
    return Error(fmt::format("{}: {} numbers; {} are needed", name, numbers.size(), wanted));
  for (const double number : numbers) {
    if (!std::isfinite(number)) return Error(fmt::format("{}: is not finite", name));
  }
  return {};
}

Result<Placement> read_placement(const tinygltf::Node& node) {
  Placement placement;
  if (!node.matrix.empty()) {
    LFD_TRY_STATUS(check_numbers(node.matrix, 16, "matrix"));
    placement.matrix = glm::make_mat4(node.matrix.data());
    const glm::dmat4& m = *placement.matrix;
    if (m[0][3] != 0 || m[1][3] != 0 || m[2][3] != 0 || m[3][3] != 1)
      return Error("matrix: the last row is not 0 0 0 1");
    return placement;
  }
  if (!node.translation.empty()) {
    LFD_TRY_STATUS(check_numbers(node.translation, 3, "translation"));
    placement.translation = glm::make_vec3(node.translation.data());
  }
  if (!node.scale.empty()) {
    LFD_TRY_STATUS(check_numbers(node.scale, 3, "scale"));
    placement.scale = glm::make_vec3(node.scale.data());
  }
  if (!node.rotation.empty()) {
    LFD_TRY_STATUS(check_numbers(node.rotation, 4, "rotation"));
    const std::vector<double>& q = node.rotation;
    const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
    if (!(length > 0) || !std::isfinite(length)) return Error("rotation: is no quaternion of a rotation");
    placement.rotation = glm::dquat(q[3] / length, q[0] / length, q[1] / length, q[2] / length);
  }
  return placement;
}

// The parent of every node, -1 for none. glTF allows one at most.
Result<std::vector<int>> parents_of(const tinygltf::Model& model) {
  std::vector<int> parents(model.nodes.size(), -1);
  for (std::size_t node = 0; node < model.nodes.size(); ++node) {
    for (const int child : model.nodes[node].children) {
      const Result<const tinygltf::Node*> exists = item_at(model.nodes, child, "node");
      if (!exists) return exists.error().within(label_of(model, node) + ": children");
      int& parent = parents[static_cast<std::size_t>(child)];
      if (parent >= 0) {
        return Error(fmt::format("{}: is a child of node {} and of node {}: the hierarchy must be a tree",
                                 label_of(model, static_cast<std::size_t>(child)), parent, node));
      }
      parent = static_cast<int>(node);
    }
  }
  return parents;
}

// A cycle reaches no root: every node must come to one by at most as many steps as there are nodes.
Status check_acyclic(const tinygltf::Model& model, const std::vector<int>& parents) {
  enum class State : char { kUnknown, kOnPath, kReachesRoot };
  std::vector<State> states(parents.size(), State::kUnknown);
  for (std::size_t start = 0; start < parents.size(); ++start) {
    std::vector<std::size_t> path;
    int node = static_cast<int>(start);
    while (node >= 0 && states[static_cast<std::size_t>(node)] == State::kUnknown) {
      states[static_cast<std::size_t>(node)] = State::kOnPath;
      path.push_back(static_cast<std::size_t>(node));
      node = parents[static_cast<std::size_t>(node)];
    }
    if (node >= 0 && states[static_cast<std::size_t>(node)] == State::kOnPath) {
      return Error(label_of(model, static_cast<std::size_t>(node)) + ": is its own ancestor: a cycle in the hierarchy");
    }
    for (const std::size_t passed : path) states[passed] = State::kReachesRoot;
  }
  return {};
}

Result<std::vector<int>> roots_of(const tinygltf::Model& model, const std::vector<int>& parents) {
  std::vector<int> roots;
  if (model.scenes.empty()) {
    for (std::size_t node = 0; node < parents.size(); ++node) {
      if (parents[node] < 0) roots.push_back(static_cast<int>(node));
    }
    return roots;
  }
  const int chosen = model.defaultScene >= 0 ? model.defaultScene : 0;
  LFD_TRY(const tinygltf::Scene* scene, item_at(model.scenes, chosen, "scene"));
  for (const int root : scene->nodes) {
    const Result<const tinygltf::Node*> exists = item_at(model.nodes, root, "node");
    if (!exists) return exists.error().within(label("scene", static_cast<std::size_t>(chosen), scene->name));
    roots.push_back(root);
  }
  return roots;
}

}  // namespace

Result<ReadNodes> read_nodes(const tinygltf::Model& model) {
  LFD_TRY(const std::vector<int> parents, parents_of(model));
  LFD_TRY_STATUS(check_acyclic(model, parents));
  LFD_TRY(const std::vector<int> roots, roots_of(model, parents));
  ReadNodes result;
  result.tree_node.assign(model.nodes.size(), -1);
  std::vector<int> open(roots.rbegin(),
                        roots.rend());  // a stack, so that nodes come in the file's order, parents first
  while (!open.empty()) {
    const auto node = static_cast<std::size_t>(open.back());
    open.pop_back();
    if (result.tree_node[node] >= 0) {
      return Error(label_of(model, node) + ": is in the scene twice: the hierarchy must be a tree");
    }
    Result<Placement> placement = read_placement(model.nodes[node]);
    if (!placement) return placement.error().within(label_of(model, node));
    const int parent = parents[node] < 0 ? -1 : result.tree_node[static_cast<std::size_t>(parents[node])];
    result.tree_node[node] = static_cast<int>(result.tree.size());
    result.model_node.push_back(node);
    result.tree.push_back({parent, *std::move(placement)});
    const std::vector<int>& children = model.nodes[node].children;
    open.insert(open.end(), children.rbegin(), children.rend());
  }
  return result;
}

}  // namespace lfd::scene::gltf
