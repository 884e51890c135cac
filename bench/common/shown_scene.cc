// A file, or one of the made scenes.
#include "bench/common/shown_scene.h"

#include "base/log.h"
#include "controller/scene/made/made_scenes.h"

namespace lfd::bench {

Result<LoadedScene> load_shown_scene(const Deployment& deployment) {
  if (deployment.scene_file) return load_scene(*deployment.scene_file);
  const auto& made = deployment.message.scene().made();
  return scene::make_scene(made.name(), made.seed());
}

std::string shown_scene_name(const Deployment& deployment) {
  if (deployment.scene_file) return deployment.scene_file->filename().string();
  const auto& made = deployment.message.scene().made();
  return fmt::format("{} (made, seed {})", made.name(), made.seed());
}

}  // namespace lfd::bench
