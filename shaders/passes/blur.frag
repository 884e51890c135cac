// Passes 4 and 5: one direction of the separable Gaussian; pixels without a surface weigh nothing.
#version 450 core
#include "shared/bindings.glsl"
#include "lib/ao_value.glsl"

layout(location = 1) uniform ivec2 direction;
layout(location = 2) uniform int taps;         // to each side
layout(location = 3) uniform float weights[25];  // of the distances 0 .. taps
layout(binding = UNIT_AO) uniform sampler2DArray ao;
#ifdef BENT
layout(binding = UNIT_NORMAL) uniform sampler2DArray normals;
#endif

flat in int layer;
layout(location = 0) out AoValue out_ao;

vec3 normal_of(ivec2 pixel) {
#ifdef BENT
  return normalize(texelFetch(normals, ivec3(pixel, layer), 0).xyz);
#else
  return vec3(0.0);
#endif
}

AoValue value_of(ivec2 pixel) { return leaning(texelFetch(ao, ivec3(pixel, layer), 0), normal_of(pixel)); }

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  AoValue centre = value_of(pixel);
  out_ao = kNoSurface;
  if (hidden_of(centre) < 0.0) return;
  ivec2 last = textureSize(ao, 0).xy - 1;
  AoValue sum = weights[0] * centre;
  float weight = weights[0];
  for (int i = 1; i <= taps; ++i) {
    for (int side = -1; side <= 1; side += 2) {
      ivec2 at = pixel + side * i * direction;
      if (any(lessThan(at, ivec2(0))) || any(greaterThan(at, last))) continue;
      AoValue value = value_of(at);
      if (hidden_of(value) < 0.0) continue;
      sum += weights[i] * value;
      weight += weights[i];
    }
  }
  out_ao = upright(sum / weight, normal_of(pixel));
}
