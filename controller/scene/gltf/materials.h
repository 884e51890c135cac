// Materials of a glTF file as those that are distributed, with their pictures.
#pragma once

#include <tiny_gltf.h>

#include <string>
#include <vector>

#include "base/result.h"
#include "controller/scene/gltf/document.h"
#include "controller/scene/scene_builder.h"

namespace lfd::scene::gltf {

struct ReadMaterial {
  std::uint32_t index = 0;  // in the scene
  int uv_set = -1;          // TEXCOORD set of the base colour texture; -1: no texture
};

// Adds all materials to the scene; if any primitive names none, at the end also the one that glTF gives it then.
// `warnings` gets what a material asks for and is not given.
Result<std::vector<ReadMaterial>> read_materials(const Document& document, SceneBuilder& scene,
                                                 std::vector<std::string>& warnings);

}  // namespace lfd::scene::gltf
