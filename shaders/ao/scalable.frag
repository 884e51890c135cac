// scalable: the alchemy estimator over a spiral of taps; the further a tap, the coarser the level of the pyramid it reads, so that
// neighbours read the same texels (McGuire, Mara & Luebke 2012).
#version 450 core
#include "ao/method.glsl"

layout(std140, binding = BINDING_AO_METHOD) uniform Parameters {
  float levels;   // of the pyramid, the full picture counted
  float sigma;    // radii
  float beta;     // radii
  float epsilon;  // squared radii
  float turns;    // of the spiral
};

const float kFinestReach_px = 8.0;  // taps nearer than this read the full picture (2^q', section 2.2)

float occlusion(Spot spot, float radius) {
  Disk disk = disk_across(spot, radius, 6.28318530718 * noise().x);
  float sum = 0.0;
  int count = sample_count(spot);
  for (int i = 0; i < count; ++i) {
    float share = (float(i) + 0.5) / float(count), angle = 6.28318530718 * turns * share;
    vec2 offset = disk.pixels_per_m * (share * radius * vec2(cos(angle), sin(angle)));
    int level = clamp(int(floor(log2(max(length(offset), 1.0) / kFinestReach_px))) + 1, 0, int(levels) - 1);
    ivec2 pixel = ivec2(floor(own_place() + offset));
    ivec2 size = (textureSize(positions, 0).xy + (1 << level) - 1) >> level;
    vec4 surface = level == 0 ? surface_of(pixel) : surface_of_level(level, pixel >> level, size);
    vec3 v = (surface.xyz - spot.p) / radius;
    if (surface.w == 0.0 || dot(v, v) > 1.0) continue;
    sum += 2.0 * share * max(0.0, dot(v, spot.normal) - beta) / (dot(v, v) + epsilon);  // 2 share: rings outward are longer
  }
  return 2.0 * sigma / float(count) * sum;
}
