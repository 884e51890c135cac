// Pass 1, Z prepass: only what the G-buffer pass would draw leaves its depth.
#version 450 core
#include "shared/bindings.glsl"
#include "shared/module_params.glsl"
#include "shared/frame_params.glsl"
#include "shared/primitive_plane.glsl"
#include "shared/draw_record.glsl"
#include "lib/optics.glsl"
#include "lib/image_map.glsl"
#include "passes/surface.glsl"

layout(std140, binding = BINDING_FRAME) uniform Frame { FrameParams frame; };

flat in uvec4 draw;
#ifdef ATTRIBUTES
in vec4 color;
#endif
#ifdef ALPHA_MASK
flat in float alpha_cutoff;
#endif

void main() {
  ModuleParams m = modules[draw.x];
  vec4 p = point_of_fragment(m, draw.y + uint(gl_PrimitiveID), frame.depth.zx);
  if (p.w == 0.0 || (p.w < 0.0 && (draw.w & DRAW_DOUBLE_SIDED) == 0u)) discard;
#ifdef ALPHA_MASK
  if (mask_alpha() * color.a < alpha_cutoff) discard;
#endif
}
