// Geometry passes with tessellation, third stage: the new vertices are placed as corners are.
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

layout(triangles, equal_spacing, ccw) in;
in vec3 patch_p[];
in vec3 patch_normal[];
in vec2 patch_uv[];
in vec4 patch_color[];
in uvec4 patch_record[];

void main() {
  vec3 b = gl_TessCoord;
  place(b.x * patch_p[0] + b.y * patch_p[1] + b.z * patch_p[2],
        b.x * patch_normal[0] + b.y * patch_normal[1] + b.z * patch_normal[2],
        b.x * patch_uv[0] + b.y * patch_uv[1] + b.z * patch_uv[2],
        b.x * patch_color[0] + b.y * patch_color[1] + b.z * patch_color[2], patch_record[0]);
}
