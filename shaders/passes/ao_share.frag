// Ambient occlusion of a surface point as the mean of what the modules beside its own found there. A neighbour counts where the pixel that
// shows the point shows the same surface: in its tangent plane but for a pixel's size, near it, and turned alike.
#version 450 core
#include "shared/bindings.glsl"
#include "shared/module_params.glsl"
#include "shared/frame_params.glsl"
#include "shared/sharing_params.glsl"
#include "lib/optics.glsl"
#include "lib/image_map.glsl"
#include "lib/sampling.glsl"
#include "lib/surface_noise.glsl"

layout(std140, binding = BINDING_MODULES) uniform Modules { ModuleParams modules[MODULES_PER_NODE]; };
layout(std140, binding = BINDING_FRAME) uniform Frame { FrameParams frame; };
layout(std140, binding = BINDING_SHARING) uniform Sharing { SharingParams sharing[MODULES_PER_NODE]; };
layout(binding = UNIT_POSITION) uniform sampler2DArray positions;
layout(binding = UNIT_NORMAL) uniform sampler2DArray normals;
layout(binding = UNIT_AO) uniform sampler2DArray ao;

flat in int layer;
layout(location = 0) out float out_ao;

// In pixel sizes. The pixel that shows a point lies up to 0.7 from it in the image, on a slanted surface further in the world.
const float most_off_plane = 1.0, most_apart = 8.0;
const float least_alike = 0.9;  // cosine of normals

void main() {
  ivec3 at = ivec3(gl_FragCoord.xy, layer);
  out_ao = texelFetch(ao, at, 0).r;
  if (out_ao < 0.0) return;
  vec3 p = texelFetch(positions, at, 0).xyz, n = normalize(texelFetch(normals, at, 0).xyz);
  vec3 p_in_physical = vec3(dot(frame.physical_from_world_0, vec4(p, 1.0)), dot(frame.physical_from_world_1, vec4(p, 1.0)),
                            dot(frame.physical_from_world_2, vec4(p, 1.0)));
  float size = pixel_size_at(modules[layer], frame, p_in_physical);
  float sum = out_ao, count = 1.0;
  int last = int(sharing[layer].window.y);
  for (int rank = int(sharing[layer].window.x); rank <= last; ++rank) {
    int other = int(sharing[rank].rank.x);
    if (other == layer) continue;
    vec4 q = image_from_physical(modules[other], p_in_physical);
    if (q.w == 0.0) continue;
    ivec3 there = ivec3(q.xy, other);
    vec4 surface = texelFetch(positions, there, 0);
    vec3 v = surface.xyz - p;
    if (surface.w == 0.0 || abs(dot(v, n)) > most_off_plane * size || dot(v, v) > most_apart * most_apart * size * size) continue;
    if (dot(texelFetch(normals, there, 0).xyz, n) < least_alike) continue;
    sum += texelFetch(ao, there, 0).r;
    count += 1.0;
  }
  out_ao = sum / count;
}
