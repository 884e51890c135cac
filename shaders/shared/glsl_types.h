// Lets C++ compile the structs of shaders/shared: GLSL's names of types, in a layout that std140 and std430 share
// (vec4; uint in draw_record alone).
#pragma once

#include <cstdint>
#include <glm/vec4.hpp>

namespace lfd::shared {

using vec4 = glm::vec4;
using uint = std::uint32_t;

#include "shaders/shared/ao_params.glsl"
#include "shaders/shared/bindings.glsl"
#include "shaders/shared/color_params.glsl"
#include "shaders/shared/draw_record.glsl"
#include "shaders/shared/frame_params.glsl"
#include "shaders/shared/light_params.glsl"
#include "shaders/shared/material_params.glsl"
#include "shaders/shared/module_params.glsl"
#include "shaders/shared/pattern_params.glsl"
#include "shaders/shared/primitive_plane.glsl"
#include "shaders/shared/sharing_params.glsl"

}  // namespace lfd::shared
