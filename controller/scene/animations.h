// How a scene moves: keyframes of nodes' placements, and where what moves is at any time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "controller/scene/node_tree.h"
#include "proto/scene.pb.h"

namespace lfd::scene {

// One property of one node over time. Before the first key the first value holds, after the last key the last.
struct Channel {
  enum class Path { kTranslation, kRotation, kScale };
  enum class Interpolation { kStep, kLinear, kCubicSpline };

  std::size_t node = 0;  // index in the node tree
  Path path = Path::kTranslation;
  Interpolation interpolation = Interpolation::kLinear;
  std::vector<double> time_s;  // strictly increasing, at least one
  std::vector<glm::dvec4>
      values;  // one per key; x y z of a rotation first, then w. Cubic: in-tangent, value, out-tangent
};

// The value of a channel: rotations are unit quaternions (x, y, z, w).
glm::dvec4 value_at(const Channel& channel, double seconds);

// What stands on a node.
struct PlacedInstance {
  std::size_t node = 0;
  std::uint32_t material = 0;
  std::string mesh;
  std::string mirrored_mesh;  // placed instead where the node's transform mirrors; empty: it never does
};

struct PlacedLight {
  std::size_t node = 0;
  proto::Light light;  // position and direction are not set
};

// What stands on nodes that move, at some time. Meshes are always named.
struct Moved {
  std::vector<proto::MovedInstance> instances;
  std::vector<proto::MovedLight> lights;
};

class Animations {
 public:
  Animations() = default;
  // `instances` and `lights` are in the order of those of the proto::Scene. Nodes without a channel that have no node
  // with one above them, and what stands on them, are looked at here and never again.
  Animations(const NodeTree& tree, std::vector<Channel> channels, const std::vector<PlacedInstance>& instances,
             const std::vector<PlacedLight>& lights);

  // Nothing moves.
  bool empty() const { return channels_.empty(); }

  std::size_t channel_count() const { return channels_.size(); }
  std::size_t moving_node_count() const { return moving_.size(); }

  // Time of the last key of all channels. Whoever wants a loop takes the time modulo this.
  double duration_s() const { return duration_s_; }

  // All that moves, by ascending index.
  Moved at(double seconds) const;

 private:
  struct MovingNode {
    Node node;                                    // its parent: in moving_
    std::optional<glm::dmat4> world_from_parent;  // of a parent that rests
  };
  template <class T>
  struct Indexed {
    std::uint32_t index;  // in the proto::Scene
    T placed;             // its node: in moving_
  };

  std::vector<std::size_t> add_moving_nodes(const NodeTree& tree, const std::vector<bool>& is_animated);
  // Of moving_.
  std::vector<glm::dmat4> world_from_nodes_at(double seconds) const;

  std::vector<Channel> channels_;   // their nodes: in moving_
  std::vector<MovingNode> moving_;  // parents before their children
  std::vector<Indexed<PlacedInstance>> instances_;
  std::vector<Indexed<PlacedLight>> lights_;
  double duration_s_ = 0;
};

// A light of a node as it stands in the world: at the node's origin, shining along its -z.
proto::Light light_in_world(proto::Light light, const glm::dmat4& world_from_node);

}  // namespace lfd::scene
