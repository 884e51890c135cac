// starcraft: samples in the half of the ball on the surface's open side; a surface d in front of a sample hides it wholly up to one
// radius, then by radius / d (Filion & McNaughton 2008).
#version 450 core
#include "ao/method.glsl"

float occlusion(Spot spot, float radius) {
  mat3 turn = axes_of_display() * random_rotation(noise());
  float sum = 0.0;
  int count = sample_count(spot);
  for (int i = 0; i < count; ++i) {
    vec3 offset = turn * sample_of(i).xyz;
    if (dot(offset, spot.normal) < 0.0) offset = -offset;
    vec3 point = spot.p + radius * offset;
    vec4 surface = surface_before(spot.m, point);
    float hidden = surface.w != 0.0 ? min(1.0, radius / max(distance(surface.xyz, point), 1e-30)) : 0.0;
    sum += hidden;
    see(normalize(offset), 1.0 - hidden);
  }
  return sum / float(count);
}
