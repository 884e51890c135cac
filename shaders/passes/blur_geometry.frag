// Passes 4 and 5, blur that knows the surfaces (Aalund 2013, section 5.3): one direction of neighbours on each side, weighed by how alike
// they are, not by their distance in the image. Pixels without a surface weigh nothing.
#version 450 core
#include "shared/bindings.glsl"
#include "shared/frame_params.glsl"
#include "shared/ao_params.glsl"
#include "lib/likeness.glsl"

layout(std140, binding = BINDING_FRAME) uniform Frame { FrameParams frame; };
layout(std140, binding = BINDING_AO) uniform Ao { AoParams ao_params; };
layout(binding = UNIT_POSITION) uniform sampler2DArray positions;
layout(binding = UNIT_NORMAL) uniform sampler2DArray normals;
layout(binding = UNIT_AO) uniform sampler2DArray ao;

layout(location = 1) uniform ivec2 direction;
layout(location = 2) uniform int taps;  // on each side

flat in int layer;
layout(location = 0) out float out_ao;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy), last = textureSize(ao, 0).xy - 1;
  float centre = texelFetch(ao, ivec3(pixel, layer), 0).r;
  out_ao = centre;
  if (centre < 0.0) return;
  vec3 p = texelFetch(positions, ivec3(pixel, layer), 0).xyz;
  vec3 n = normalize(texelFetch(normals, ivec3(pixel, layer), 0).xyz);
  float sum = centre, weight = 1.0;
  for (int i = -taps; i <= taps; ++i) {
    ivec2 at = pixel + i * direction;
    if (i == 0 || any(lessThan(at, ivec2(0))) || any(greaterThan(at, last))) continue;
    float value = texelFetch(ao, ivec3(at, layer), 0).r;
    if (value < 0.0) continue;
    float w = likeness(n, normalize(texelFetch(normals, ivec3(at, layer), 0).xyz),
                       depth_between(frame, p, texelFetch(positions, ivec3(at, layer), 0).xyz), ao_params.radii.x);
    sum += w * value;
    weight += w;
  }
  out_ao = sum / weight;
}
