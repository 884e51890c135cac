// hbao: marches along directions across the pixel's own line; every surface that raises the horizon above the tangent plane adds the
// rise of the horizon's sine, weighed by 1 - r^2 / R^2 (Bavoil et al. 2008).
#version 450 core
#include "ao/method.glsl"

layout(std140, binding = BINDING_AO_METHOD) uniform Parameters {
  float directions;
  float steps;
  float bias;  // rad
};

float occlusion(Spot spot, float radius) {
  vec3 random = noise();
  int count = count_at(spot, int(directions));
  float turn = 6.28318530718 / float(count);  // from one direction to the next
  Disk disk = disk_across(spot, radius, turn * random.x);
  float facing = max(dot(spot.normal, disk.view), 1e-3);
  float sum = 0.0;
  for (int i = 0; i < count; ++i) {
    float angle = turn * float(i);
    vec2 direction = vec2(cos(angle), sin(angle));
    vec3 along = direction.x * disk.x + direction.y * disk.y;
    float highest = sin(min(atan(-dot(spot.normal, along), facing) + bias, 1.57079632679));
    for (int j = 0; j < int(steps); ++j) {
      vec4 surface = surface_at_offset(disk, radius * ((float(j) + random.y) / steps) * direction);
      vec3 v = surface.xyz - spot.p;
      float r2 = dot(v, v);
      if (surface.w == 0.0 || r2 >= radius * radius || r2 == 0.0) continue;
      float height = dot(v, disk.view) * inversesqrt(r2);
      if (height <= highest) continue;
      sum += (height - highest) * (1.0 - r2 / (radius * radius));
      highest = height;
    }
  }
  return sum / float(count);
}
