// schmitt: eight neighbours in the compass directions, each at a random distance; how far their surface lies in front, over the largest
// distance that counts, looks up an occlusion function that falls from 1 to 0. Surfaces behind, too far in front, or with almost the
// same normal hide nothing (Schmitt 2008).
#version 450 core
#include "ao/method.glsl"

layout(std140, binding = BINDING_AO_METHOD) uniform Parameters {
  float range;     // radii
  float parallel;  // cosine
};

float occlusion(Spot spot, float radius) {
  Disk disk = disk_across(spot, radius, 0.0);
  float sum = 0.0, random = noise().x;
  for (int i = 0; i < 8; ++i) {
    float angle = 0.78539816340 * float(i);
    float share = fract(random + 0.61803398875 * float(i));  // eight distances that differ, turned for each pixel
    vec2 offset = radius * max(share, 0.05) * vec2(cos(angle), sin(angle));
    ivec2 pixel = ivec2(floor(own_place() + disk.pixels_per_m * offset));
    vec4 surface = surface_of(pixel);
    if (surface.w == 0.0) continue;
    float difference = dot(surface.xyz - spot.p, disk.view) / (range * radius);
    if (difference <= 0.0 || difference > 1.0) continue;
    if (dot(normalize(texelFetch(normals, ivec3(pixel, layer), 0).xyz), spot.normal) >= parallel) continue;
    sum += 1.0 - difference;
  }
  return sum / 8.0;
}
