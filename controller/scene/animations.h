// How a scene moves: keyframes of nodes' placements, and the instances and lights at any time.
#pragma once

#include <cstdint>
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

class Animations {
 public:
  Animations() = default;
  Animations(NodeTree tree, std::vector<Channel> channels, std::vector<PlacedInstance> instances,
             std::vector<PlacedLight> lights);

  // Nothing moves.
  bool empty() const { return channels_.empty(); }

  std::size_t channel_count() const { return channels_.size(); }

  // Time of the last key of all channels. Whoever wants a loop takes the time modulo this.
  double duration_s() const;

  // All instances of the scene at a time, in the order of proto::Scene.instance. Empty if nothing moves.
  std::vector<proto::Instance> at(double seconds) const;

  // Likewise the lights that stand on nodes, in the order of proto::Scene.light. Empty if nothing moves or none stands
  // on a node.
  std::vector<proto::Light> lights_at(double seconds) const;

 private:
  std::vector<glm::dmat4> world_from_nodes_at(double seconds) const;

  NodeTree tree_;
  std::vector<Channel> channels_;
  std::vector<PlacedInstance> instances_;
  std::vector<PlacedLight> lights_;
};

// A light of a node as it stands in the world: at the node's origin, shining along its -z.
proto::Light light_in_world(proto::Light light, const glm::dmat4& world_from_node);

}  // namespace lfd::scene
