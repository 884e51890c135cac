// Geometry passes with tessellation, first stage: a corner of a patch goes on as it is.
#version 450 core

layout(location = 0) in vec3 p_in_physical;
layout(location = 1) in vec3 normal_in_world;
layout(location = 2) in vec2 uv_in;
layout(location = 3) in vec4 color_in;
layout(location = 4) in uvec4 record;  // a DrawRecord, one per command

out vec3 corner_p;
out vec3 corner_normal;
out vec2 corner_uv;
out vec4 corner_color;
out uvec4 corner_record;

void main() {
  corner_p = p_in_physical;
  corner_normal = normal_in_world;
  corner_uv = uv_in;
  corner_color = color_in;
  corner_record = record;
}
