// crytek: samples in the whole ball, mirrored in a plane of each pixel's own (Mittring 2007). A surface however far in front hides
// them: halos around what stands before something are the method's own.
#version 450 core
#include "ao/method.glsl"

float occlusion(Spot spot, float radius) {
  mat3 axes = axes_of_display();
  vec3 mirror = random_rotation(noise())[2];
  int hidden = 0;
  for (int i = 0; i < sample_count(); ++i) {
    if (surface_before(spot.m, spot.p + radius * (axes * reflect(sample_of(i).xyz, mirror))).w != 0.0) ++hidden;
  }
  return float(hidden) / float(sample_count());
}
