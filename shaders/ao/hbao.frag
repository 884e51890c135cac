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
    float tangent = atan(-dot(spot.normal, along), facing), lowest = sin(tangent);
    float highest = sin(min(tangent + bias, 1.57079632679));
    vec2 all = arc_above(lowest), open = all;
    float open_share = 1.0 - lowest;
    for (int j = 0; j < int(steps); ++j) {
      vec4 surface = surface_at_offset(disk, radius * ((float(j) + random.y) / steps) * direction);
      vec3 v = surface.xyz - spot.p;
      float r2 = dot(v, v);
      if (surface.w == 0.0 || r2 >= radius * radius || r2 == 0.0) continue;
      float height = dot(v, disk.view) * inversesqrt(r2);
      if (height <= highest) continue;
      float weight = 1.0 - r2 / (radius * radius);
      sum += (height - highest) * weight;
      // Pixels lie beside the direction, where a slanted plane is higher: that hides nothing of it.
      if (dot(v, spot.normal) * inversesqrt(r2) > 0.002) {
        open -= weight * (arc_above(highest) - arc_above(height));
        open_share -= weight * (height - highest);
      }
      highest = height;
    }
    mat2x3 slice = mat2x3(along, disk.view);
    see(slice * all, slice * open, 1.0 - lowest, open_share);
  }
  return sum / float(count);
}
