// unreal: pairs of samples on both sides of the pixel; the angles between their surfaces and the viewers, no lower than the tangent
// plane, leave 1 - mean(angle + angle) / pi hidden (Mittring 2012). A sample that is too far in front, or has no surface, is the
// straight continuation of its partner; where both are, nothing is hidden.
#version 450 core
#include "ao/method.glsl"

layout(std140, binding = BINDING_AO_METHOD) uniform Parameters {
  float bias;
  float range;  // radii
};

// Angle to the viewers, rad; -1: not believed.
float angle_of(Spot spot, Disk disk, vec2 offset, float radius) {
  vec4 surface = surface_at_offset(disk, offset);
  vec3 v = surface.xyz - spot.p;
  float r2 = dot(v, v);
  if (surface.w == 0.0 || r2 == 0.0 || dot(v, disk.view) > range * radius) return -1.0;
  vec3 s = v * inversesqrt(r2);
  float above = dot(s, spot.normal);
  float cosine = dot(disk.view, s);
  if (above < 0.0) {
    vec3 tangent = s - above * spot.normal;
    float length2 = dot(tangent, tangent);
    cosine = length2 > 0.0 ? dot(disk.view, tangent) * inversesqrt(length2) : 0.0;
  }
  return acos(clamp(cosine - bias, -1.0, 1.0));
}

float occlusion(Spot spot, float radius) {
  const float pi = 3.14159265359;
  Disk disk = disk_across(spot, radius, 2.0 * pi * noise().x);
  float sum = 0.0;
  int count = paired_count(spot);
  for (int i = 0; i + 1 < count; i += 2) {
    float one = angle_of(spot, disk, radius * sample_of(i).xy, radius);
    float other = angle_of(spot, disk, radius * sample_of(i + 1).xy, radius);
    sum += one >= 0.0 && other >= 0.0 ? min(one + other, pi) : pi;
  }
  return 1.0 - sum / (pi * float(count / 2));
}
