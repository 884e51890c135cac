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
#include "lib/spaces.glsl"
#include "lib/surface_noise.glsl"
#include "lib/ao_value.glsl"

layout(std140, binding = BINDING_MODULES) uniform Modules { ModuleParams modules[MODULES_PER_NODE]; };
layout(std140, binding = BINDING_FRAME) uniform Frame { FrameParams frame; };
layout(std140, binding = BINDING_SHARING) uniform Sharing { SharingParams sharing[MODULES_PER_NODE]; };
layout(binding = UNIT_POSITION) uniform sampler2DArray positions;
layout(binding = UNIT_NORMAL) uniform sampler2DArray normals;
layout(binding = UNIT_AO) uniform sampler2DArray ao;

flat in int layer;
layout(location = 0) out AoValue out_ao;

// In pixel sizes. The pixel that shows a point lies up to 0.7 from it in the image, on a slanted surface further in the world.
const float most_off_plane = 1.0, most_apart = 8.0;
const float least_alike = 0.9;  // cosine of normals

void main() {
  ivec3 at = ivec3(gl_FragCoord.xy, layer);
  vec4 own = texelFetch(ao, at, 0);
  out_ao = kNoSurface;
  if (own.r < 0.0) return;
  vec3 p = texelFetch(positions, at, 0).xyz, n = normalize(texelFetch(normals, at, 0).xyz);
  vec3 p_in_physical = physical_from_world(frame, p);
  float size = pixel_size_at(modules[layer], frame, p_in_physical);
  AoValue sum = leaning(own, n);
  float count = 1.0, band = modules[layer].tangential.w;  // beside its own image a module finds nothing
  int last = int(sharing[layer].window.y);
  for (int rank = int(sharing[layer].window.x); rank <= last; ++rank) {
    int other = int(sharing[rank].rank.x);
    if (other == layer) continue;
    vec4 q = image_from_physical(modules[other], p_in_physical);
    if (q.w == 0.0 || any(lessThan(q.xy, vec2(band))) || any(greaterThanEqual(q.xy, modules[other].screen.zw - band))) continue;
    ivec3 there = ivec3(q.xy, other);
    vec4 surface = texelFetch(positions, there, 0);
    vec3 v = surface.xyz - p;
    if (surface.w < 1.0 || abs(dot(v, n)) > most_off_plane * size ||
        dot(v, v) > most_apart * most_apart * size * size)
      continue;
    vec3 n_there = texelFetch(normals, there, 0).xyz;
    if (dot(n_there, n) < least_alike) continue;
    sum += leaning(texelFetch(ao, there, 0), normalize(n_there));
    count += 1.0;
  }
  out_ao = upright(sum / count, n);
}
