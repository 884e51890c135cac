// Scenes out to files, and what they contain in numbers.
#pragma once

#include <cstddef>
#include <filesystem>

#include "base/result.h"
#include "proto/scene_data.h"

namespace lfd::scene {

// Writes the scene as one .glb file. Ambient and head lights are left out: glTF has none. Refuses textures with a
// transform.
Status write_glb(const std::filesystem::path& path, const SceneData& data);

struct Census {
  std::size_t faces = 0;     // of all instances
  std::size_t meshes = 0;    // assets
  std::size_t pictures = 0;  // assets
};

// Refuses a scene that names an asset it does not have, or a mesh that is not sound.
Result<Census> census_of(const SceneData& data);

}  // namespace lfd::scene
