// Passes 4 and 5: one direction of the separable Gaussian; pixels without a surface weigh nothing.
#version 450 core
#include "shared/bindings.glsl"

layout(location = 1) uniform ivec2 direction;
layout(location = 2) uniform int taps;         // to each side
layout(location = 3) uniform float weights[25];  // of the distances 0 .. taps
layout(binding = UNIT_AO) uniform sampler2DArray ao;

flat in int layer;
layout(location = 0) out float out_ao;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float centre = texelFetch(ao, ivec3(pixel, layer), 0).r;
  out_ao = centre;
  if (centre < 0.0) return;
  ivec2 last = textureSize(ao, 0).xy - 1;
  float sum = weights[0] * centre, weight = weights[0];
  for (int i = 1; i <= taps; ++i) {
    for (int side = -1; side <= 1; side += 2) {
      ivec2 at = pixel + side * i * direction;
      if (any(lessThan(at, ivec2(0))) || any(greaterThan(at, last))) continue;
      float value = texelFetch(ao, ivec3(at, layer), 0).r;
      if (value < 0.0) continue;
      sum += weights[i] * value;
      weight += weights[i];
    }
  }
  out_ao = sum / weight;
}
