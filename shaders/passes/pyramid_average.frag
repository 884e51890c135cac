// One level of the pyramid of positions: the mean of the surfaces among 3 x 3 pixels of the level before (Pyramid HBAO, 2021, section 3.3).
#version 450 core
#include "shared/bindings.glsl"

layout(location = 1) uniform int finer_mip;
layout(location = 2) uniform ivec2 finer_size;
layout(binding = UNIT_POSITION) uniform sampler2DArray finer;

flat in int layer;
layout(location = 0) out vec4 out_position;  // w 1, or 0 where none of them shows a surface

void main() {
  ivec2 first = 3 * ivec2(gl_FragCoord.xy), last = finer_size - 1;
  vec3 sum = vec3(0.0);
  float count = 0.0;
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 3; ++x) {
      ivec2 at = first + ivec2(x, y);
      vec4 p = any(greaterThan(at, last)) ? vec4(0.0) : texelFetch(finer, ivec3(at, layer), finer_mip);
      if (p.w == 0.0) continue;
      sum += p.xyz;
      count += 1.0;
    }
  }
  out_position = count == 0.0 ? vec4(0.0) : vec4(sum / count, 1.0);
}
