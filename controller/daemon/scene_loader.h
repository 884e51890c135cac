// Loads scenes on a thread of its own, one at a time, while frames go on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "base/result.h"
#include "controller/scene/loaded_scene.h"
#include "proto/deployment.pb.h"
#include "proto/wire/mailbox.h"

namespace lfd::controller {

using SceneSource = std::variant<std::filesystem::path, proto::Deployment::Made>;

struct SceneArrival {
  std::string asker;  // address of the client that is to hear of it; empty: nobody asked, it is the first scene
  std::uint64_t request_id = 0;  // of that client
  Result<LoadedScene> scene;
};

class SceneLoader {
 public:
  SceneLoader();

  bool busy() const { return busy_; }

  // Starts to load. Not while busy.
  void start(SceneSource source, std::string asker, std::uint64_t request_id);

  // Readable when a scene (or its error) has arrived.
  int descriptor() const { return arrivals_->descriptor(); }
  std::optional<SceneArrival> take();

 private:
  // Shared with the loading thread, which nobody waits for: a load cannot be interrupted, and a process that ends
  // leaves it.
  std::shared_ptr<wire::Mailbox<SceneArrival>> arrivals_;
  bool busy_ = false;
};

}  // namespace lfd::controller
