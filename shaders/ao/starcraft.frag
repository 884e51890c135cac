// starcraft: samples in the half of the ball on the surface's open side; a surface d in front of a sample hides it wholly up to one
// radius, then by radius / d (Filion & McNaughton 2008).
#version 450 core
#include "ao/method.glsl"

float occlusion(Spot spot, float radius) {
  mat3 turn = axes_of_display() * random_rotation(noise());
  float sum = 0.0;
  for (int i = 0; i < sample_count(); ++i) {
    vec3 offset = turn * sample_of(i).xyz;
    vec3 point = spot.p + radius * (dot(offset, spot.normal) < 0.0 ? -offset : offset);
    vec4 surface = surface_before(spot.m, point);
    if (surface.w != 0.0) sum += min(1.0, radius / max(distance(surface.xyz, point), 1e-30));
  }
  return sum / float(sample_count());
}
