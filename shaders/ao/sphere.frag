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
  int count = symmetric != 0.0 ? paired_count(spot) : sample_count(spot);
  for (int i = 0; i < count; ++i) {
    vec3 offset = turn * sample_of(i).xyz;
    bool is_hidden = surface_before(spot.m, spot.p + radius * offset).w != 0.0;
    if (is_hidden) ++hidden;
    if (dot(offset, spot.normal) > 0.0) see(normalize(offset), is_hidden ? 0.0 : 1.0);
  }
  return float(hidden) / float(count);
}
