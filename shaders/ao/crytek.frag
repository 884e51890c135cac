// crytek: samples in the whole ball, mirrored in a plane of each pixel's own (Mittring 2007). A surface however far in front hides
// them: halos around what stands before something are the method's own.
#version 450 core
#include "ao/method.glsl"

float occlusion(Spot spot, float radius) {
  mat3 axes = axes_of_display();
  vec3 mirror = random_rotation(noise())[2];
  int hidden = 0;
  int count = sample_count(spot);
  for (int i = 0; i < count; ++i) {
    vec3 offset = axes * reflect(sample_of(i).xyz, mirror);
    bool is_hidden = surface_before(spot.m, spot.p + radius * offset).w != 0.0;
    if (is_hidden) ++hidden;
    if (dot(offset, spot.normal) > 0.0) see(normalize(offset), is_hidden ? 0.0 : 1.0);
  }
  return float(hidden) / float(count);
}
