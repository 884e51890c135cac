// Images of points in physical space by every module: images[module * points + point]. One row of groups per module.
#version 450 core
layout(local_size_x = 64) in;
#include "shared/module_params.glsl"
#include "lib/optics.glsl"
#include "lib/image_map.glsl"

layout(std430, binding = 0) readonly buffer Points { vec4 points[]; };
layout(std430, binding = 1) writeonly buffer Images { vec4 images[]; };
layout(std430, binding = 2) readonly buffer Modules { ModuleParams modules[]; };

void main() {
  uint count = uint(points.length());
  if (gl_GlobalInvocationID.x >= count) return;
  uint module = gl_WorkGroupID.y;
  vec3 p = points[gl_GlobalInvocationID.x].xyz;
  images[module * count + gl_GlobalInvocationID.x] = image_from_physical(modules[module], p);
}
