// One level of the pyramid of positions: one of 2 x 2 pixels of the level before, by turns another one, so that no position is made up
// (McGuire, Mara & Luebke 2012, "Scalable ambient obscurance", section 2.2).
#version 450 core
#include "shared/bindings.glsl"

layout(location = 1) uniform int finer_mip;
layout(location = 2) uniform ivec2 finer_size;
layout(binding = UNIT_POSITION) uniform sampler2DArray finer;

flat in int layer;
layout(location = 0) out vec4 out_position;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy), last = finer_size - 1;
  ivec2 at = min(2 * pixel + ivec2((pixel.y & 1) ^ 1, (pixel.x & 1) ^ 1), last);
  out_position = texelFetch(finer, ivec3(at, layer), finer_mip);
}
