// Keyframes to places.
#include "controller/scene/animations.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "controller/scene/scene_builder.h"

namespace lfd::scene {
namespace {

constexpr std::size_t kRests = std::numeric_limits<std::size_t>::max();

glm::dvec4 unit(glm::dvec4 q) {
  const double length = glm::length(q);
  return length > 0 ? q / length : glm::dvec4(0, 0, 0, 1);
}

// The shorter way round, at constant speed.
glm::dvec4 slerp(glm::dvec4 a, glm::dvec4 b, double t) {
  double cosine = glm::dot(a, b);
  if (cosine < 0) {
    b = -b;
    cosine = -cosine;
  }
  if (cosine > 1 - 1e-12) return unit(a + t * (b - a));  // sin(angle) would be a division by about zero
  const double angle = std::acos(cosine);
  return (std::sin((1 - t) * angle) * a + std::sin(t * angle) * b) / std::sin(angle);
}

// glTF 2.0, appendix C.5: Hermite with tangents per second; three values per key.
glm::dvec4 cubic(const Channel& channel, std::size_t key, double t, double step_s) {
  const glm::dvec4 from = channel.values[3 * key + 1];
  const glm::dvec4 out_tangent = step_s * channel.values[3 * key + 2];
  const glm::dvec4 in_tangent = step_s * channel.values[3 * key + 3];
  const glm::dvec4 to = channel.values[3 * key + 4];
  const double t2 = t * t;
  const double t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * from + (t3 - 2 * t2 + t) * out_tangent + (3 * t2 - 2 * t3) * to +
         (t3 - t2) * in_tangent;
}

glm::dvec4 value_of_key(const Channel& channel, std::size_t key) {
  return channel.values[channel.interpolation == Channel::Interpolation::kCubicSpline ? 3 * key + 1 : key];
}

glm::dvec4 interpolated(const Channel& channel, double seconds) {
  const std::vector<double>& time = channel.time_s;
  if (!(seconds > time.front())) return value_of_key(channel, 0);
  if (seconds >= time.back()) return value_of_key(channel, time.size() - 1);
  const auto next = std::ranges::upper_bound(time, seconds);
  const auto key = static_cast<std::size_t>(next - time.begin()) - 1;
  const double step_s = time[key + 1] - time[key];
  const double t = (seconds - time[key]) / step_s;
  switch (channel.interpolation) {
    case Channel::Interpolation::kStep:
      return channel.values[key];
    case Channel::Interpolation::kCubicSpline:
      return cubic(channel, key, t, step_s);
    case Channel::Interpolation::kLinear:
      break;
  }
  if (channel.path == Channel::Path::kRotation)
    return slerp(unit(channel.values[key]), unit(channel.values[key + 1]), t);
  return channel.values[key] + t * (channel.values[key + 1] - channel.values[key]);
}

void apply(const Channel& channel, double seconds, Placement& placement) {
  const glm::dvec4 value = value_at(channel, seconds);
  switch (channel.path) {
    case Channel::Path::kTranslation:
      placement.translation = glm::dvec3(value);
      break;
    case Channel::Path::kRotation:
      placement.rotation = glm::dquat(value.w, value.x, value.y, value.z);
      break;
    case Channel::Path::kScale:
      placement.scale = glm::dvec3(value);
      break;
  }
}

}  // namespace

glm::dvec4 value_at(const Channel& channel, double seconds) {
  const glm::dvec4 value = interpolated(channel, seconds);
  return channel.path == Channel::Path::kRotation ? unit(value) : value;
}

Animations::Animations(const NodeTree& tree, std::vector<Channel> channels,
                       const std::vector<PlacedInstance>& instances, const std::vector<PlacedLight>& lights)
    : channels_(std::move(channels)) {
  std::vector<bool> is_animated(tree.size(), false);
  for (const Channel& channel : channels_) {
    is_animated[channel.node] = true;
    duration_s_ = std::max(duration_s_, channel.time_s.back());
  }
  const std::vector<std::size_t> moving_of = add_moving_nodes(tree, is_animated);
  for (Channel& channel : channels_) channel.node = moving_of[channel.node];
  for (std::size_t i = 0; i < instances.size(); ++i) {
    if (moving_of[instances[i].node] == kRests) continue;
    instances_.push_back({static_cast<std::uint32_t>(i), instances[i]});
    instances_.back().placed.node = moving_of[instances[i].node];
  }
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (moving_of[lights[i].node] == kRests) continue;
    lights_.push_back({static_cast<std::uint32_t>(i), lights[i]});
    lights_.back().placed.node = moving_of[lights[i].node];
  }
}

// Returns the index in moving_ of every node of the tree.
std::vector<std::size_t> Animations::add_moving_nodes(const NodeTree& tree, const std::vector<bool>& is_animated) {
  const std::vector<glm::dmat4> world_from_node = world_from_nodes(tree);
  std::vector<std::size_t> moving_of(tree.size(), kRests);
  for (std::size_t node = 0; node < tree.size(); ++node) {
    const bool has_parent = tree[node].parent >= 0;
    const auto parent = static_cast<std::size_t>(tree[node].parent);
    const bool parent_moves = has_parent && moving_of[parent] != kRests;
    if (!is_animated[node] && !parent_moves) continue;
    moving_of[node] = moving_.size();
    MovingNode moving{
        .node = {.parent = parent_moves ? static_cast<int>(moving_of[parent]) : -1, .placement = tree[node].placement},
        .world_from_parent = {}};
    if (has_parent && !parent_moves) moving.world_from_parent = world_from_node[parent];
    moving_.push_back(moving);
  }
  return moving_of;
}

std::vector<glm::dmat4> Animations::world_from_nodes_at(double seconds) const {
  std::vector<Placement> placements;
  placements.reserve(moving_.size());
  for (const MovingNode& moving : moving_) placements.push_back(moving.node.placement);
  for (const Channel& channel : channels_) apply(channel, seconds, placements[channel.node]);
  std::vector<glm::dmat4> result;
  result.reserve(moving_.size());
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    const glm::dmat4 parent_from_node = placements[i].parent_from_node();
    const MovingNode& moving = moving_[i];
    if (moving.node.parent >= 0) {
      result.push_back(result[static_cast<std::size_t>(moving.node.parent)] * parent_from_node);
    } else {
      result.push_back(moving.world_from_parent ? *moving.world_from_parent * parent_from_node : parent_from_node);
    }
  }
  return result;
}

Moved Animations::at(double seconds) const {
  Moved result;
  const std::vector<glm::dmat4> world_from_node = world_from_nodes_at(seconds);
  for (const auto& [index, placed] : instances_) {
    const glm::dmat4& world_from_mesh = world_from_node[placed.node];
    const bool mirrored = !placed.mirrored_mesh.empty() && mirrors(world_from_mesh);
    proto::MovedInstance& moved = result.instances.emplace_back();
    moved.set_index(index);
    moved.set_mesh(mirrored ? placed.mirrored_mesh : placed.mesh);
    const auto rows = upper_rows(world_from_mesh);
    moved.mutable_world_from_mesh()->Assign(rows.begin(), rows.end());
  }
  for (const auto& [index, placed] : lights_) {
    proto::MovedLight& moved = result.lights.emplace_back();
    moved.set_index(index);
    *moved.mutable_light() = light_in_world(placed.light, world_from_node[placed.node]);
  }
  return result;
}

proto::Light light_in_world(proto::Light light, const glm::dmat4& world_from_node) {
  if (light.kind() != proto::Light::DIRECTIONAL) {
    *light.mutable_position() = vector_message(glm::dvec3(world_from_node[3]));
  }
  if (light.kind() != proto::Light::POINT) {
    const glm::dvec3 along = -glm::dvec3(world_from_node[2]);
    const double length = glm::length(along);
    *light.mutable_direction() = vector_message(length > 0 ? along / length : glm::dvec3(0, 0, -1));
  }
  return light;
}

}  // namespace lfd::scene
