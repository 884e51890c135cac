// Pass 2, G-buffer: base colour, world position and normal of the visible surface.
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
in vec3 normal;
in vec4 color;
#ifdef ALPHA_MASK
flat in float alpha_cutoff;
#endif

layout(location = 0) out vec4 out_albedo;    // linear colour; alpha 1 lit, 0.5 unlit, 0 no surface
#ifdef WRITE_POSITION
layout(location = 1) out vec4 out_position;  // world minus ROI centre; w 1, or 0.5 where no viewer sees it
#endif
#ifdef WRITE_NORMAL
layout(location = 2) out vec4 out_normal;    // world, unit, on the side that is seen; w likewise
#endif

void main() {
  vec4 base = texel();
  ModuleParams m = modules[draw.x];
  vec4 p = point_of_fragment(m, draw.y + uint(gl_PrimitiveID), frame.depth.zx);
  if (p.w == 0.0 || (p.w < 0.0 && (draw.w & DRAW_DOUBLE_SIDED) == 0u)) discard;
  base *= color;
#ifdef ALPHA_MASK
  if (mask_alpha() * color.a < alpha_cutoff) discard;
#endif
  float there = 1.0;
  out_albedo = vec4(base.rgb, (draw.w & DRAW_UNLIT) != 0u ? 0.5 : 1.0);
#ifdef GUARD_BAND
  if (!is_seen_or_band(m, gl_FragCoord.xy)) {
    there = 0.5;
    out_albedo = vec4(frame.background.rgb, 0.0);
  }
#endif
#ifdef WRITE_POSITION
  vec4 q = vec4(p.xyz, 1.0);
  out_position = vec4(dot(frame.world_from_physical_0, q), dot(frame.world_from_physical_1, q), dot(frame.world_from_physical_2, q), there);
#endif
#ifdef WRITE_NORMAL
  // Between corners whose normals are opposite there is a place without one.
  out_normal = vec4((dot(normal, normal) > 0.0 ? normalize(normal) : vec3(0.0, 0.0, 1.0)) * p.w, there);
#endif
}
