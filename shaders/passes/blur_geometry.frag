// Passes 4 and 5, blur that knows the surfaces (Aalund 2013, section 5.3): one direction of neighbours on each side, weighed by how alike
// they are, not by their distance in the image. Pixels without a surface weigh nothing.
#version 450 core
#include "shared/bindings.glsl"
#include "shared/frame_params.glsl"
#include "shared/ao_params.glsl"
#include "lib/likeness.glsl"
#include "lib/ao_value.glsl"

layout(std140, binding = BINDING_FRAME) uniform Frame { FrameParams frame; };
layout(std140, binding = BINDING_AO) uniform Ao { AoParams ao_params; };
layout(binding = UNIT_POSITION) uniform sampler2DArray positions;
layout(binding = UNIT_NORMAL) uniform sampler2DArray normals;
layout(binding = UNIT_AO) uniform sampler2DArray ao;

layout(location = 1) uniform ivec2 direction;
layout(location = 2) uniform int taps;  // on each side

flat in int layer;
layout(location = 0) out AoValue out_ao;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy), last = textureSize(ao, 0).xy - 1;
  vec4 centre = texelFetch(ao, ivec3(pixel, layer), 0);
  out_ao = kNoSurface;
  if (centre.r < 0.0) return;
  vec3 p = texelFetch(positions, ivec3(pixel, layer), 0).xyz;
  vec3 n = normalize(texelFetch(normals, ivec3(pixel, layer), 0).xyz);
  AoValue sum = leaning(centre, n);
  float weight = 1.0;
  for (int i = -taps; i <= taps; ++i) {
    ivec2 at = pixel + i * direction;
    if (i == 0 || any(lessThan(at, ivec2(0))) || any(greaterThan(at, last))) continue;
    vec4 value = texelFetch(ao, ivec3(at, layer), 0);
    if (value.r < 0.0) continue;
    vec3 n_there = normalize(texelFetch(normals, ivec3(at, layer), 0).xyz);
    float w = likeness(n, n_there,
                       depth_between(frame, p, texelFetch(positions, ivec3(at, layer), 0).xyz), ao_params.radii.x);
    sum += w * leaning(value, n_there);
    weight += w;
  }
  out_ao = upright(sum / weight, n);
}
