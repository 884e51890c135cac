// The loading thread.
#include "controller/daemon/scene_loader.h"

#include <thread>

#include "base/check.h"
#include "controller/scene/made/made_scenes.h"

namespace lfd::controller {
namespace {

Result<LoadedScene> load(const SceneSource& source) {
  if (const auto* made = std::get_if<proto::Deployment::Made>(&source))
    return scene::make_scene(made->name(), made->seed());
  return load_scene(std::get<std::filesystem::path>(source));
}

}  // namespace

SceneLoader::SceneLoader() : arrivals_(std::make_shared<wire::Mailbox<SceneArrival>>(1)) {}

void SceneLoader::start(SceneSource source, std::string asker, std::uint64_t request_id) {
  LFD_CHECK(!busy_, "one scene is loaded at a time");
  busy_ = true;
  std::thread([arrivals = arrivals_, source = std::move(source), asker = std::move(asker), request_id] {
    arrivals->put(SceneArrival{asker, request_id, load(source)});
  }).detach();
}

std::optional<SceneArrival> SceneLoader::take() {
  std::optional<SceneArrival> arrival = arrivals_->take();
  if (arrival) busy_ = false;
  return arrival;
}

}  // namespace lfd::controller
