// Pass 6, post processing: lights, and ambient occlusion through its curve. The target applies the sRGB transfer.
#version 450 core
#include "shared/bindings.glsl"
#include "shared/frame_params.glsl"
#include "shared/light_params.glsl"
#include "lib/curve.glsl"
#include "lib/lights.glsl"

layout(std140, binding = BINDING_FRAME) uniform Frame { FrameParams frame; };
layout(std430, binding = BINDING_LIGHTS) readonly buffer Lights { LightParams lights[]; };
layout(binding = UNIT_ALBEDO) uniform sampler2DArray albedo;
layout(binding = UNIT_POSITION) uniform sampler2DArray positions;
layout(binding = UNIT_NORMAL) uniform sampler2DArray normals;
layout(binding = UNIT_AO) uniform sampler2DArray ao;

flat in int layer;
layout(location = 0) out vec4 out_color;

vec3 lit(vec3 base, vec3 position, vec3 normal, float openness) {
  vec3 light = vec3(0.0);
  for (int i = 0; i < int(frame.background.w); ++i) {
    LightParams l = lights[i];
    if (l.color_kind.w == 0.0) {
      light += l.color_kind.rgb * (frame.ambient_occlusion.w == 1.0 ? openness : 1.0);
    } else {
      vec4 a = arriving(l, position);
      light += l.color_kind.rgb * (a.w * max(dot(normal, a.xyz), 0.0));
    }
  }
  return base * light;
}

void main() {
  ivec3 at = ivec3(gl_FragCoord.xy, layer);
  vec4 base = texelFetch(albedo, at, 0);
  if (base.a == 0.0) {
    out_color = vec4(frame.background.rgb, 1.0);
    return;
  }
  out_color = vec4(base.rgb, 1.0);
  if (base.a < 0.75) return;  // unlit
  float openness = 1.0;
#ifdef READ_AO
  openness = 1.0 - post_curve(max(texelFetch(ao, at, 0).r, 0.0), frame.ambient_occlusion.xyz);
#endif
  vec3 position = vec3(0.0), normal = vec3(0.0);
#ifdef READ_POSITION
  position = texelFetch(positions, at, 0).xyz;
#endif
#ifdef READ_NORMAL
  normal = normalize(texelFetch(normals, at, 0).xyz);
#endif
  out_color.rgb = lit(base.rgb, position, normal, openness);
  if (frame.ambient_occlusion.w == 2.0) out_color.rgb *= openness;
}
