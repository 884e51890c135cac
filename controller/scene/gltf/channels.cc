// Animation channels of a glTF file.
#include "controller/scene/gltf/channels.h"

#include <cmath>
#include <optional>

#include "base/log.h"
#include "controller/scene/gltf/accessors.h"
#include "controller/scene/gltf/document.h"

namespace lfd::scene::gltf {
namespace {

// Absent: a path that is not supported (and that the warning of the whole file names).
std::optional<Channel::Path> path_of(const std::string& name) {
  if (name == "translation") return Channel::Path::kTranslation;
  if (name == "rotation") return Channel::Path::kRotation;
  if (name == "scale") return Channel::Path::kScale;
  return std::nullopt;
}

Result<Channel::Interpolation> interpolation_of(const std::string& name) {
  if (name.empty() || name == "LINEAR") return Channel::Interpolation::kLinear;
  if (name == "STEP") return Channel::Interpolation::kStep;
  if (name == "CUBICSPLINE") return Channel::Interpolation::kCubicSpline;
  return Error(fmt::format("interpolation: \"{}\" is none of STEP, LINEAR, CUBICSPLINE", name.substr(0, 40)));
}

Result<std::vector<double>> read_times(const tinygltf::Model& model, int accessor) {
  LFD_TRY(const std::vector<float> floats, read_floats(model, accessor, 1));
  for (std::size_t i = 0; i < floats.size(); ++i) {
    const bool sound = std::isfinite(floats[i]) && floats[i] >= 0 && (i == 0 || floats[i] > floats[i - 1]);
    if (!sound) return Error(fmt::format("accessor {}: key {}: times must be >= 0 and grow", accessor, i));
  }
  return std::vector<double>(floats.begin(), floats.end());
}

Result<std::vector<glm::dvec4>> read_values(const tinygltf::Model& model, int accessor, int components) {
  LFD_TRY(const std::vector<float> floats, read_floats(model, accessor, components));
  const auto width = static_cast<std::size_t>(components);
  std::vector<glm::dvec4> values(floats.size() / width, glm::dvec4(0.0));
  for (std::size_t i = 0; i < floats.size(); ++i) {
    if (!std::isfinite(floats[i])) return Error(fmt::format("accessor {}: key {}: is not finite", accessor, i / width));
    values[i / width][static_cast<int>(i % width)] = floats[i];
  }
  return values;
}

Status read_sampler(const tinygltf::Model& model, const tinygltf::AnimationSampler& sampler, Channel& channel) {
  LFD_TRY(channel.interpolation, interpolation_of(sampler.interpolation));
  Result<std::vector<double>> times = read_times(model, sampler.input);
  if (!times) return times.error().within("input");
  channel.time_s = *std::move(times);
  Result<std::vector<glm::dvec4>> values =
      read_values(model, sampler.output, channel.path == Channel::Path::kRotation ? 4 : 3);
  if (!values) return values.error().within("output");
  channel.values = *std::move(values);
  const std::size_t per_key = channel.interpolation == Channel::Interpolation::kCubicSpline ? 3 : 1;
  if (channel.values.size() != per_key * channel.time_s.size()) {
    return Error(fmt::format("output: {} values for {} keys", channel.values.size(), channel.time_s.size()));
  }
  return {};
}

// Absent: the channel moves nothing in the scene.
Result<std::optional<Channel>> read_channel(const tinygltf::Model& model, const tinygltf::Animation& animation,
                                            const tinygltf::AnimationChannel& from, const NodeTree& tree,
                                            const std::vector<int>& tree_node) {
  const std::optional<Channel::Path> path = path_of(from.target_path);
  if (!path || from.target_node < 0) return std::optional<Channel>();
  if (const auto exists = item_at(model.nodes, from.target_node, "node"); !exists) return exists.error();
  LFD_TRY(const tinygltf::AnimationSampler* sampler, item_at(animation.samplers, from.sampler, "sampler"));
  Channel channel;
  channel.path = *path;
  const Status read = read_sampler(model, *sampler, channel);
  if (!read) return read.error().within(fmt::format("sampler {}", from.sampler));
  const int node = tree_node[static_cast<std::size_t>(from.target_node)];
  if (node < 0) return std::optional<Channel>();
  channel.node = static_cast<std::size_t>(node);
  if (tree[channel.node].placement.matrix) {
    return Error(fmt::format("node {}: is animated and has a matrix; glTF allows only one", from.target_node));
  }
  return std::optional<Channel>(std::move(channel));
}

}  // namespace

Result<std::vector<Channel>> read_channels(const tinygltf::Model& model, const NodeTree& tree,
                                           const std::vector<int>& tree_node) {
  std::vector<Channel> channels;
  for (std::size_t a = 0; a < model.animations.size(); ++a) {
    const tinygltf::Animation& animation = model.animations[a];
    for (std::size_t c = 0; c < animation.channels.size(); ++c) {
      Result<std::optional<Channel>> channel = read_channel(model, animation, animation.channels[c], tree, tree_node);
      if (!channel)
        return channel.error().within(fmt::format("{}: channel {}", label("animation", a, animation.name), c));
      if (*channel) channels.push_back(**std::move(channel));
    }
  }
  return channels;
}

}  // namespace lfd::scene::gltf
