// The scene that a deployment shows.
#pragma once

#include <string>

#include "base/result.h"
#include "controller/scene/loaded_scene.h"
#include "proto/deployment_file.h"

namespace lfd::bench {

// Reads its file, or makes it. Errors: those of the file.
Result<LoadedScene> load_shown_scene(const Deployment& deployment);

// "Sponza.gltf", or "ribbed-shell (made, seed 1)".
std::string shown_scene_name(const Deployment& deployment);

}  // namespace lfd::bench
