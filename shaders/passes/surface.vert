// Both geometry passes: a vertex in physical space to the clip space of one module (one layer).
#version 450 core
#extension GL_ARB_shader_viewport_layer_array : require
#include "shared/bindings.glsl"
#include "shared/module_params.glsl"
#include "shared/frame_params.glsl"
#include "shared/draw_record.glsl"
#include "shared/material_params.glsl"
#include "lib/optics.glsl"
#include "lib/image_map.glsl"
#include "passes/surface_place.glsl"

layout(location = 0) in vec3 p_in_physical;
layout(location = 1) in vec3 normal_in_world;
layout(location = 2) in vec2 uv_in;
layout(location = 3) in vec4 color_in;
layout(location = 4) in uvec4 record;  // a DrawRecord, one per command

void main() { place(p_in_physical, normal_in_world, uv_in, color_in, record); }
