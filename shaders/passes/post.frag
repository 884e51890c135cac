// Pass 6, post processing: lights, ambient occlusion through its curve, last the module's colour. The target applies
// the sRGB transfer.
#version 450 core
#include "shared/bindings.glsl"
#include "shared/color_params.glsl"
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
#ifdef COLOR
#include "lib/color.glsl"
#include "shared/ao_params.glsl"
layout(std140, binding = BINDING_COLORS) uniform Colors { ColorParams colors[MODULES_PER_NODE]; };
layout(std140, binding = BINDING_AO) uniform Ao { AoParams ao_params; };
#endif

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
  return base * min(light, vec3(1e30));  // sums may be infinite, and nothing of them is lost: 0 times that is no number
}

// What the pixel is meant to show, linear.
vec3 light_of(ivec3 at) {
  vec4 base = texelFetch(albedo, at, 0);
  if (base.a == 0.0) return frame.background.rgb;
  if (base.a < 0.75) return base.rgb;  // unlit
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
#ifdef BENT
  vec3 open = texelFetch(ao, at, 0).gba;
  if (dot(open, open) > 0.0) normal = normalize(open);
#endif
#endif
  vec3 light = lit(base.rgb, position, normal, openness);
  return frame.ambient_occlusion.w == 2.0 ? light * openness : light;
}

void main() {
  out_color = vec4(light_of(ivec3(gl_FragCoord.xy, layer)), 1.0);
#ifdef COLOR
  ColorParams color = colors[layer];
  if (!has_color(color)) return;
  float band = ao_params.options.y;  // gains are those of the image without it
  vec3 gain = gain_at(color, (gl_FragCoord.xy - band) / (vec2(textureSize(albedo, 0).xy) - 2.0 * band));
  out_color.rgb = stored_as(drive_for(color, gain, out_color.rgb));
#endif
}
