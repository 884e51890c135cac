// One function for every made scene.
#pragma once

#include <cstdint>

#include "controller/scene/made/made_scenes.h"
#include "controller/scene/scene_builder.h"

namespace lfd::scene {

// Each fills an empty builder.
using Recipe = Status (*)(std::uint64_t seed, Extent extent, SceneBuilder& scene);

Status make_ribbed_shell(std::uint64_t seed, Extent extent, SceneBuilder& scene);
Status make_room(std::uint64_t seed, Extent extent, SceneBuilder& scene);
Status make_quad(std::uint64_t seed, Extent extent, SceneBuilder& scene);
Status make_depth_steps(std::uint64_t seed, Extent extent, SceneBuilder& scene);
Status make_plane(std::uint64_t seed, Extent extent, SceneBuilder& scene);
Status make_wall(std::uint64_t seed, Extent extent, SceneBuilder& scene);
Status make_corner(std::uint64_t seed, Extent extent, SceneBuilder& scene);

}  // namespace lfd::scene
