// march: rays about the normal, as likely as their cosine to it, marched in jittered steps; the first step that a stored surface hides,
// and that is no further behind it than its thickness, counts 1 - r / R.
#version 450 core
#include "ao/method.glsl"

layout(std140, binding = BINDING_AO_METHOD) uniform Parameters {
  float steps;
  float thickness;  // radii
};

float hidden_along(Spot spot, vec3 direction, float radius, float jitter) {
  for (int j = 0; j < int(steps); ++j) {
    float share = (float(j) + jitter) / steps;
    vec3 point = spot.p + share * radius * direction;
    vec4 surface = surface_before(spot.m, point);
    if (surface.w != 0.0 && distance(surface.xyz, point) <= thickness * radius) return 1.0 - share;
  }
  return 0.0;
}

float occlusion(Spot spot, float radius) {
  vec3 random = noise();
  mat3 axes = axes_of_display();
  mat3 frame_of_normal = axes * frame_about(normalize(spot.normal * axes), 6.28318530718 * random.x);  // v * m: m^T v
  float sum = 0.0;
  int count = sample_count(spot);
  for (int i = 0; i < count; ++i) {
    vec3 direction = frame_of_normal * sample_of(i).xyz;
    float hidden = hidden_along(spot, direction, radius, fract(sample_of(i).w + random.y));
    sum += hidden;
    see(direction, 1.0 - hidden);
  }
  return sum / float(count);
}
