// Pass 3, ambient occlusion by samples in a spherical shell (Doronin et al., WSCG 2017, Algorithm 2), in the light-field form:
// a sample counts as hidden if the surface stored where its image is lies in front of it (larger depth).
#version 450 core
#include "shared/bindings.glsl"
#include "shared/module_params.glsl"
#include "shared/frame_params.glsl"
#include "shared/ao_params.glsl"
#include "lib/optics.glsl"
#include "lib/image_map.glsl"
#include "lib/sampling.glsl"

layout(std140, binding = BINDING_MODULES) uniform Modules { ModuleParams modules[MODULES_PER_NODE]; };
layout(std140, binding = BINDING_FRAME) uniform Frame { FrameParams frame; };
layout(std140, binding = BINDING_AO) uniform Ao { AoParams ao; };
layout(std140, binding = BINDING_AO_SAMPLES) uniform AoSamples { vec4 samples[AO_MOST_SAMPLES]; };  // in the unit shell
layout(binding = UNIT_POSITION) uniform sampler2DArray positions;

flat in int layer;
layout(location = 0) out float out_hidden;  // share of hidden samples; -1 where there is no surface

// physical point of a world point counted from the ROI centre
vec3 physical_from_world(vec3 p) {
  return vec3(dot(frame.physical_from_world_0, vec4(p, 1.0)), dot(frame.physical_from_world_1, vec4(p, 1.0)),
              dot(frame.physical_from_world_2, vec4(p, 1.0)));
}

// Position stored at a point of the image: on the surface through four pixels where all of them have one, else that of the pixel it
// lies in. A sample of a slanted plane so meets the plane on its own line, not on that of a pixel up to half a pixel away.
vec4 surface_at(vec2 pixel) {
  ivec2 most = textureSize(positions, 0).xy - 2;
  vec4 nearest = texelFetch(positions, ivec3(pixel, layer), 0);
  if (any(lessThan(most, ivec2(0)))) return nearest;
  ivec2 first = clamp(ivec2(floor(pixel - 0.5)), ivec2(0), most);  // at the border the surface goes on straight for half a pixel
  vec2 share = pixel - 0.5 - vec2(first);
  ivec3 at = ivec3(first, layer);
  vec4 above = mix(texelFetch(positions, at, 0), texelFetch(positions, at + ivec3(1, 0, 0), 0), share.x);
  vec4 below = mix(texelFetch(positions, at + ivec3(0, 1, 0), 0), texelFetch(positions, at + ivec3(1, 1, 0), 0), share.x);
  vec4 surface = mix(above, below, share.y);
  return abs(surface.w - 1.0) < 1e-4 ? surface : nearest;
}

bool is_hidden(ModuleParams m, vec3 s_in_world) {
  vec4 q = image_from_physical(m, physical_from_world(s_in_world));
  if (q.w == 0.0) return false;
  vec4 surface = surface_at(q.xy);
  return surface.w != 0.0 && depth_of(m, physical_from_world(surface.xyz)) > q.z;
}

void main() {
  vec4 p = texelFetch(positions, ivec3(gl_FragCoord.xy, layer), 0);
  out_hidden = -1.0;
  if (p.w == 0.0) return;
  ModuleParams m = modules[layer];
  mat3 turn = rotation_of_pixel(uvec2(gl_FragCoord.xy), uint(m.tangential.z), uint(ao.radii.w));
  int count = int(ao.radii.z);
  float radius = ao.radii.x;
  float most = 0.0;
  for (int level = 0; level < int(ao.radii.y); ++level, radius *= 0.5) {
    int hidden = 0;
    for (int i = 0; i < count; ++i) {
      if (is_hidden(m, p.xyz + radius * (turn * samples[i].xyz))) ++hidden;
    }
    most = max(most, float(hidden) / float(count));
  }
  out_hidden = most;
}
