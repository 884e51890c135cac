// Pass 3, what all methods of ambient occlusion share. A method's file includes this and defines occlusion(); its numbers are floats
// in a uniform block `Parameters` (proto/occlusion/NAME.cc), its sample set is `samples`.
#include "shared/bindings.glsl"
#include "shared/module_params.glsl"
#include "shared/frame_params.glsl"
#include "shared/ao_params.glsl"
#include "lib/optics.glsl"
#include "lib/half_resolution.glsl"
#include "lib/image_map.glsl"
#include "lib/sampling.glsl"
#include "lib/spaces.glsl"
#include "lib/ao_value.glsl"
#include "ao/open_directions.glsl"
#ifdef SHARED
#include "shared/sharing_params.glsl"
#include "lib/surface_noise.glsl"
#endif

layout(std140, binding = BINDING_MODULES) uniform Modules { ModuleParams modules[MODULES_PER_NODE]; };
layout(std140, binding = BINDING_FRAME) uniform Frame { FrameParams frame; };
layout(std140, binding = BINDING_AO) uniform Ao { AoParams ao; };
layout(std140, binding = BINDING_AO_SAMPLES) uniform AoSamples { vec4 samples[AO_MOST_SAMPLES]; };
#ifdef SHARED
layout(std140, binding = BINDING_SHARING) uniform Sharing { SharingParams sharing[MODULES_PER_NODE]; };
#endif
layout(binding = UNIT_POSITION) uniform sampler2DArray positions;
#ifdef NORMAL
layout(binding = UNIT_NORMAL) uniform sampler2DArray normals;
#endif

#ifdef PYRAMID
// Positions at lower resolutions: mip level k - 1 is level k of the pyramid. Level 0 is `positions`.
layout(binding = UNIT_PYRAMID) uniform sampler2DArray pyramid;
#endif

flat in int layer;
layout(location = 0) out AoValue out_value;  // 0 open, 1 hidden; -1 where there is no surface

// The surface of the pixel that is shaded.
struct Spot {
  ModuleParams m;
  vec3 p;       // world minus ROI centre
  vec3 normal;  // world, unit, on the side that is seen; of methods that read normals, and with BENT
};

// 0 open, 1 hidden, within the radius (m, in the world). Methods that know directions see() them.
float occlusion(Spot spot, float radius);

// The pixel of the full picture that is shaded, and its middle.
ivec2 own_pixel() {
#ifdef HALF_RESOLUTION
  return full_pixel(ivec2(gl_FragCoord.xy), textureSize(positions, 0).xy);
#else
  return ivec2(gl_FragCoord.xy);
#endif
}
vec2 own_place() { return vec2(own_pixel()) + 0.5; }

#ifdef SHARED
vec3 noise_of_point;  // that is shaded

// Three numbers in [0, 1): of the point, and what this module's differ by from its neighbours'.
vec3 noise() { return fract(noise_of_point + sharing[layer].turn.xyz); }

// The i-th sample of this module's own part of the set that it has together with its neighbours.
vec4 sample_of(int i) { return samples[int(sharing[layer].window.z) + i]; }
#else
// Three numbers in [0, 1) of this pixel of this module, whatever its guard band.
vec3 noise() { return noise_of_pixel(uvec2(own_pixel() - int(ao.options.y)), uint(modules[layer].tangential.z), uint(ao.radii.w)); }

vec4 sample_of(int i) { return samples[i]; }
#endif

vec3 physical_from_world(vec3 p) { return physical_from_world(frame, p); }

// The display's axes in the world, unit. What is random is laid out along them, so that pictures do not know how the world is turned.
mat3 axes_of_display() {
  mat3 world_from_physical =
      transpose(mat3(frame.world_from_physical_0.xyz, frame.world_from_physical_1.xyz, frame.world_from_physical_2.xyz));
  return mat3(normalize(world_from_physical[0]), normalize(world_from_physical[1]), normalize(world_from_physical[2]));
}

// How many of `all` samples, directions or slices a spot takes. The further it is from the viewers, the fewer, where that is asked for
// (Aalund 2013, section 5.2.5; depth is 0 at the front limit and 1 at the back one).
int count_at(Spot spot, int all) {
  int least = int(ao.options.x);
  if (least == 0) return all;
  float depth = (frame.depth.x - depth_of(spot.m, physical_from_world(spot.p))) / (frame.depth.x - frame.depth.z);
  return clamp(int(float(all) / (1.0 + float(all) * clamp(depth, 0.0, 1.0))), min(least, all), all);
}

int sample_count(Spot spot) { return count_at(spot, int(ao.radii.z)); }

// The same of samples that come in pairs.
int paired_count(Spot spot) {
  int all = int(ao.radii.z);
  return min((count_at(spot, all) + 1) / 2 * 2, all);
}

// Stored position of a pixel; w 0 beside the image and where there is no surface, 0.5 where there is one that no viewer sees.
vec4 surface_of(ivec2 pixel) {
  if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, textureSize(positions, 0).xy))) return vec4(0.0);
  return texelFetch(positions, ivec3(pixel, layer), 0);
}

#ifdef PYRAMID
// The same of a level from 1 on; `size` of it is used.
vec4 surface_of_level(int level, ivec2 pixel, ivec2 size) {
  if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, size))) return vec4(0.0);
  return texelFetch(pyramid, ivec3(pixel, layer), level - 1);
}
#endif

// Stored position of a texel; w 1 where there is a surface, seen or not.
vec4 stored(ivec3 at) {
  vec4 p = texelFetch(positions, at, 0);
#ifdef GUARD_BAND
  p.w = ceil(p.w);
#endif
  return p;
}

// Position stored at a point of the image: on the surface through four pixels where all of them have one, else that of the pixel it
// lies in. A sample of a slanted plane so meets the plane on its own line, not on that of a pixel up to half a pixel away.
vec4 surface_at(int of_layer, vec2 pixel) {
  ivec2 last = textureSize(positions, 0).xy - 1;
  ivec2 first = clamp(ivec2(floor(pixel - 0.5)), ivec2(0), max(last - 1, 0));  // at the border the surface goes on straight for half a pixel
  ivec2 second = min(first + 1, last);
  vec2 share = pixel - 0.5 - vec2(first);
  vec4 a = stored(ivec3(first, of_layer)), b = stored(ivec3(second.x, first.y, of_layer));
  vec4 c = stored(ivec3(first.x, second.y, of_layer)), d = stored(ivec3(second, of_layer));
  vec4 surface = mix(mix(a, b, share.x), mix(c, d, share.x), share.y);
  bvec2 is_second = greaterThan(ivec2(pixel), first);
  vec4 nearest = is_second.y ? (is_second.x ? d : c) : (is_second.x ? b : a);
  return all(greaterThan(last, ivec2(0))) && abs(surface.w - 1.0) < 1e-4 ? surface : nearest;
}

#ifdef OPEN_AIR
// Whether the outermost neighbour of a side that has an image of a physical point sees it in the air: before the surface stored there, or
// where there is none. The outermost look most past whatever hides it, and asking all costs half as much again for little (march without
// a thickness, armadillo: error 0.0107 without, 0.0067 with two, 0.0063 with eight).
bool is_seen_in_air_from(int rank, int inward, vec3 p_in_physical) {
  for (;; rank += inward) {
    int other = int(sharing[rank].rank.x);
    if (other == layer) return false;
    vec4 q = image_from_physical(modules[other], p_in_physical);
    if (q.w == 0.0) continue;
    vec4 surface = surface_at(other, q.xy);
    return surface.w == 0.0 || depth_of(modules[other], physical_from_world(surface.xyz)) < q.z;
  }
}

bool is_seen_in_air(vec3 p_in_physical) {
  return is_seen_in_air_from(int(sharing[layer].window.x), 1, p_in_physical) ||
         is_seen_in_air_from(int(sharing[layer].window.y), -1, p_in_physical);
}
#endif

// The surface that hides a point from the viewers: the one stored where the point's image is, if that lies in front of it (larger
// depth). w 0 where none does; points without an image or a surface are in the open.
vec4 surface_before(ModuleParams m, vec3 p) {
  vec3 p_in_physical = physical_from_world(p);
  vec4 q = image_from_physical(m, p_in_physical);
  if (q.w == 0.0) return vec4(0.0);
  vec4 surface = surface_at(layer, q.xy);
  if (surface.w == 0.0 || !(depth_of(m, physical_from_world(surface.xyz)) > q.z)) return vec4(0.0);
#ifdef OPEN_AIR
  if (is_seen_in_air(p_in_physical)) return vec4(0.0);
#endif
  return surface;
}

// Unit vector in the world along the pixel's own line, to the viewers.
vec3 to_viewers(Spot spot) {
  vec3 d = line_direction(spot.m, screen_from_physical(spot.m, physical_from_world(spot.p)).xy);
  return normalize(vec3(dot(frame.world_from_physical_0.xyz, d), dot(frame.world_from_physical_1.xyz, d),
                        dot(frame.world_from_physical_2.xyz, d)));
}

// The plane across the pixel's own line: two axes in the world, turned by `turn` radians, and how many pixels of the image a metre
// along each is (the map's Jacobian, by differences over half a radius).
struct Disk {
  vec3 view, x, y;
  mat2 pixels_per_m;
};

// Place in the image, beside it too.
vec2 place_of(ModuleParams m, vec3 p) { return image_from_screen(m, screen_from_physical(m, physical_from_world(p)).xy).xy; }

Disk disk_across(Spot spot, float radius, float turn) {
  Disk disk;
  disk.view = to_viewers(spot);
  mat3 axes = axes_of_display();
  vec3 a = normalize(cross(abs(dot(disk.view, axes[0])) < 0.7 ? axes[0] : axes[1], disk.view)), b = cross(disk.view, a);
  disk.x = cos(turn) * a + sin(turn) * b;
  disk.y = cross(disk.view, disk.x);
  float e = 0.25 * radius;
  disk.pixels_per_m = mat2(place_of(spot.m, spot.p + e * disk.x) - place_of(spot.m, spot.p - e * disk.x),
                           place_of(spot.m, spot.p + e * disk.y) - place_of(spot.m, spot.p - e * disk.y)) / (2.0 * e);
  return disk;
}

// Stored surface at an offset (m) in the disk. w 0: none, or the pixel's own.
vec4 surface_at_offset(Disk disk, vec2 offset) {
  ivec2 pixel = ivec2(floor(own_place() + disk.pixels_per_m * offset));
  return pixel == own_pixel() ? vec4(0.0) : surface_of(pixel);
}

void main() {
  ivec3 at = ivec3(own_pixel(), layer);
  vec4 p = texelFetch(positions, at, 0);
  out_value = kNoSurface;
  if (p.w < 1.0) return;
  Spot spot = Spot(modules[layer], p.xyz, vec3(0.0));
#ifdef NORMAL
  spot.normal = normalize(texelFetch(normals, at, 0).xyz);
#endif
#ifdef SHARED
  noise_of_point = surface_noise(p.xyz, ao.noise, pixel_size_at(spot.m, frame, physical_from_world(p.xyz)));
#endif
  float radius = ao.radii.x;
  float most = 0.0;
  vec3 open = vec3(0.0);  // of the radius that hides most
  for (int level = 0; level < int(ao.radii.y); ++level, radius *= 0.5) {
    see_nothing_yet();
    float hidden = occlusion(spot, radius);
    if (level == 0 || hidden > most) open = mean_open_direction(spot.normal);
    most = max(most, hidden);
  }
  out_value = ao_value(min(most, 1.0), open);
}
