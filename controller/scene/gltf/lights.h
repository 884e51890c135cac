// Lights of KHR_lights_punctual.
#pragma once

#include <tiny_gltf.h>

#include <optional>

#include "base/result.h"
#include "proto/scene.pb.h"

namespace lfd::scene::gltf {

// The light that stands on a node, without place and direction; absent if none does. The extension counts lux and
// candela; a proto::Light counts irradiance / pi: the factor by which a white diffuse surface shines.
Result<std::optional<proto::Light>> light_of(const tinygltf::Model& model, const tinygltf::Node& node);

}  // namespace lfd::scene::gltf
