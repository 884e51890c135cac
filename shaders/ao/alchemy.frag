// alchemy: samples on a disk across the pixel's own line; v from the pixel's surface to theirs hides by
// (2 sigma / N) sum max(0, v.n - beta) / (v.v + epsilon) (McGuire et al. 2011, equation 10, with the bias in metres).
#version 450 core
#include "ao/method.glsl"

layout(std140, binding = BINDING_AO_METHOD) uniform Parameters {
  float sigma;    // radii
  float beta;     // radii
  float epsilon;  // squared radii
};

float occlusion(Spot spot, float radius) {
  Disk disk = disk_across(spot, radius, 6.28318530718 * noise().x);
  float sum = 0.0;
  int count = sample_count(spot);
  for (int i = 0; i < count; ++i) {
    vec4 surface = surface_at_offset(disk, radius * sample_of(i).xy);
    if (surface.w == 0.0) continue;
    vec3 v = (surface.xyz - spot.p) / radius;
    sum += max(0.0, dot(v, spot.normal) - beta) / (dot(v, v) + epsilon);
  }
  return 2.0 * sigma / float(count) * sum;
}
