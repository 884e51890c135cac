// A scene as the controller holds it: what is distributed, how it moves, what was left out of it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "controller/scene/animations.h"
#include "proto/scene_data.h"

namespace lfd {

struct LoadedScene {
  SceneData data;                     // at rest: before any animation has started
  scene::Animations animations;       // empty if nothing moves
  std::vector<std::string> warnings;  // for people: what the file asks for and does not get
};

// Reads a .gltf or .glb file (told apart by their first bytes) of glTF 2.0: the default scene, else the first.
// Errors name file and place: `sponza.gltf: mesh 3 "curtain": primitive 0: POSITION: accessor 17: ...`.
Result<LoadedScene> load_scene(const std::filesystem::path& path);

}  // namespace lfd
