// sphere: samples in a spherical shell (Doronin et al., WSCG 2017, Algorithm 2), in the light-field form: a sample counts as hidden if
// the surface stored where its image is lies in front of it.
#version 450 core
#include "ao/method.glsl"

layout(std140, binding = BINDING_AO_METHOD) uniform Parameters {
  float shell;      // both shape the sample set
  float symmetric;
};

float occlusion(Spot spot, float radius) {
  mat3 turn = axes_of_display() * random_rotation(noise());
  int hidden = 0;
  for (int i = 0; i < sample_count(); ++i) {
    if (surface_before(spot.m, spot.p + radius * (turn * sample_of(i).xyz)).w != 0.0) ++hidden;
  }
  return float(hidden) / float(sample_count());
}
