// Geometry passes with tessellation, second stage: how finely each edge is split, from how far its middle is drawn off its place.
// A parabola of sagitta d, cut into n pieces, keeps a sagitta of d / n^2.
#version 450 core
#include "shared/bindings.glsl"
#include "shared/module_params.glsl"
#include "shared/frame_params.glsl"
#include "lib/optics.glsl"
#include "lib/image_map.glsl"

layout(std140, binding = BINDING_MODULES) uniform Modules { ModuleParams modules[MODULES_PER_NODE]; };
layout(std140, binding = BINDING_FRAME) uniform Frame { FrameParams frame; };

layout(vertices = 3) out;
in vec3 corner_p[];
in vec3 corner_normal[];
in vec2 corner_uv[];
in vec4 corner_color[];
in uvec4 corner_record[];
out vec3 patch_p[];
out vec3 patch_normal[];
out vec2 patch_uv[];
out vec4 patch_color[];
out uvec4 patch_record[];

// Clip position of a point: pixels times w, and w; w is 0 where there is none.
vec3 clip_of(ModuleParams m, vec3 p) {
  vec4 s = screen_from_physical(m, p);
  vec3 pixel = image_from_screen(m, s.xy);
  return pixel.z == 0.0 || !(s.z > 0.0) ? vec3(0.0) : vec3(pixel.xy * s.z, s.z);
}

// The same for both triangles of an edge: its ends are taken in one order.
float pieces(ModuleParams m, vec3 a, vec3 b) {
  bool swap = a.x != b.x ? b.x < a.x : a.y != b.y ? b.y < a.y : b.z < a.z;
  vec3 p = swap ? b : a, q = swap ? a : b;
  vec3 clip_p = clip_of(m, p), clip_q = clip_of(m, q), middle = clip_of(m, 0.5 * (p + q));
  if (clip_p.z == 0.0 && clip_q.z == 0.0) return 1.0;
  if (clip_p.z == 0.0 || clip_q.z == 0.0 || middle.z == 0.0) return 64.0;
  vec3 drawn = 0.5 * (clip_p + clip_q);
  float off_px = length(middle.xy / middle.z - drawn.xy / drawn.z);
  return clamp(ceil(sqrt(off_px / frame.depth.w)), 1.0, 64.0);
}

void main() {
  patch_p[gl_InvocationID] = corner_p[gl_InvocationID];
  patch_normal[gl_InvocationID] = corner_normal[gl_InvocationID];
  patch_uv[gl_InvocationID] = corner_uv[gl_InvocationID];
  patch_color[gl_InvocationID] = corner_color[gl_InvocationID];
  patch_record[gl_InvocationID] = corner_record[gl_InvocationID];
  if (gl_InvocationID != 0) return;
  ModuleParams m = modules[corner_record[0].x];
  gl_TessLevelOuter[0] = pieces(m, corner_p[1], corner_p[2]);
  gl_TessLevelOuter[1] = pieces(m, corner_p[2], corner_p[0]);
  gl_TessLevelOuter[2] = pieces(m, corner_p[0], corner_p[1]);
  gl_TessLevelInner[0] = max(gl_TessLevelOuter[0], max(gl_TessLevelOuter[1], gl_TessLevelOuter[2]));
}
