// Ambient occlusion of half the resolution brought to the full one: the four nearest samples by their distance in the image and by how
// alike their surfaces are (as passes/blur_geometry.frag weighs them). A pixel of which none is alike takes the nearest.
#version 450 core
#include "shared/bindings.glsl"
#include "shared/frame_params.glsl"
#include "shared/ao_params.glsl"
#include "lib/half_resolution.glsl"
#include "lib/likeness.glsl"
#include "lib/ao_value.glsl"

layout(std140, binding = BINDING_FRAME) uniform Frame { FrameParams frame; };
layout(std140, binding = BINDING_AO) uniform Ao { AoParams ao_params; };
layout(binding = UNIT_POSITION) uniform sampler2DArray positions;
layout(binding = UNIT_NORMAL) uniform sampler2DArray normals;
layout(binding = UNIT_AO) uniform sampler2DArray half_ao;

flat in int layer;
layout(location = 0) out AoValue out_ao;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy), last = textureSize(half_ao, 0).xy - 1, full = textureSize(positions, 0).xy;
  vec4 p = texelFetch(positions, ivec3(pixel, layer), 0);
  out_ao = kNoSurface;
  if (p.w < 1.0) return;
  vec3 n = normalize(texelFetch(normals, ivec3(pixel, layer), 0).xyz);
  vec2 place = 0.5 * vec2(pixel);  // samples lie at pixels 2i
  ivec2 first = ivec2(floor(place));
  vec2 share = place - vec2(first);
  AoValue sum = AoValue(0.0), nearest = AoValue(0.0);
  float weight = 0.0, largest = -1.0;
  for (int k = 0; k < 4; ++k) {
    ivec2 corner = ivec2(k & 1, k >> 1), at = min(first + corner, last);
    vec4 texel = texelFetch(half_ao, ivec3(at, layer), 0);
    if (texel.r < 0.0) continue;
    ivec2 there = full_pixel(at, full);
    vec3 n_there = normalize(texelFetch(normals, ivec3(there, layer), 0).xyz);
    AoValue value = leaning(texel, n_there);
    vec2 near = mix(1.0 - share, share, vec2(corner));
    float bilinear = max(near.x * near.y, 1e-3);
    if (bilinear > largest) {
      largest = bilinear;
      nearest = value;
    }
    float w = bilinear * likeness(n, n_there,
                                  depth_between(frame, p.xyz, texelFetch(positions, ivec3(there, layer), 0).xyz), ao_params.radii.x);
    sum += w * value;
    weight += w;
  }
  out_ao = upright(weight > 1e-6 ? sum / weight : nearest, n);
}
