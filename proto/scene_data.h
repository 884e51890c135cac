// A scene with everything it names: what the controller makes of a file, and what a node has gathered before it draws.
#pragma once

#include <memory>
#include <string>
#include <unordered_map>

#include "proto/scene.pb.h"

namespace lfd {

// Serialised proto::Mesh or proto::Picture by content hash. The bytes are shared, never changed.
using Assets = std::unordered_map<std::string, std::shared_ptr<const std::string>>;

struct SceneData {
  proto::Scene scene;
  Assets assets;  // every mesh and picture that the scene names
};

}  // namespace lfd
