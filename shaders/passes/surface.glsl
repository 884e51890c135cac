// What both geometry passes do per pixel: the pixel's own line meets the triangle's plane. Needs lib/optics.glsl, lib/image_map.glsl.

layout(std140, binding = BINDING_MODULES) uniform Modules { ModuleParams modules[MODULES_PER_NODE]; };
layout(binding = UNIT_PLANES) uniform samplerBuffer planes;  // array of PrimitivePlane: software rasterisers read texels faster
layout(binding = UNIT_TEXTURE) uniform sampler2DArray base_color_texture;
#include "lib/screen_of_pixel.glsl"

// The t at which R(t) = start + t direction is on the triangle's plane, brought back to where the line leaves the scene's triangle.
// A rasteriser's corners are off by up to a hundredth of a pixel: it finds a triangle on pixels whose line passes just beside it, and
// where the triangle is grazed its plane lies far from it there. (Not of the piece that is drawn: pieces share the plane.)
float keep_in_triangle(int first_texel, float third, vec3 start, vec3 direction, float t) {
  vec4 inside_0 = texelFetch(planes, first_texel + 2), inside_1 = texelFetch(planes, first_texel + 3);
  vec3 at_start = vec3(dot(inside_0, vec4(start, 1.0)), dot(inside_1, vec4(start, 1.0)), third);
  at_start.z -= at_start.x + at_start.y;
  vec3 growth = vec3(dot(inside_0.xyz, direction), dot(inside_1.xyz, direction), 0.0);
  growth.z = -growth.x - growth.y;
  if (all(greaterThanEqual(at_start + t * growth, vec3(0.0)))) return t;
  vec3 crossing = -at_start / growth;
  vec3 entry = mix(vec3(-1e30), crossing, greaterThan(growth, vec3(0.0)));
  vec3 exit = mix(vec3(1e30), crossing, lessThan(growth, vec3(0.0)));
  float first = max(entry.x, max(entry.y, entry.z)), last = min(exit.x, min(exit.y, exit.z));
  return first <= last ? clamp(t, first, last) : t;
}

// Physical point where the line of a pixel meets the triangle (w: 1 seen from the front, -1 from behind, 0 not at all). Depths are
// within the limits: on a planar screen triangles were cut there, on a curved one it is decided here.
vec4 meet(ModuleParams m, uint primitive, vec2 limits, vec2 pixel) {
  vec2 s = screen_of_pixel(m, pixel);
  if (!on_screen(m, s)) return vec4(0.0);
  vec3 start = surface_point(m, s), direction = line_direction(m, s);
  int texel = 4 * int(primitive);
  vec4 normal_offset = texelFetch(planes, texel), range_bounds = texelFetch(planes, texel + 1);
  float slope = dot(normal_offset.xyz, direction);
  float t = (normal_offset.w - dot(normal_offset.xyz, start)) / slope;
  bool is_grazed = slope * slope < range_bounds.w * dot(direction, direction);
  if (is_curved(m)) {
    if (slope == 0.0) return vec4(0.0);
    if (is_grazed) t = keep_in_triangle(texel, range_bounds.z, start, direction, t);
    if (!(t * m.observer.y >= limits.x && t * m.observer.y <= limits.y)) return vec4(0.0);
  } else {
    vec2 range = range_bounds.xy / m.observer.y;
    t = clamp(slope == 0.0 ? range.y : t, range.x, range.y);
    if (is_grazed) t = clamp(keep_in_triangle(texel, range_bounds.z, start, direction, t), range.x, range.y);
  }
  return vec4(start + t * direction, slope >= 0.0 ? 1.0 : -1.0);
}

// The visible point of a fragment (w as above), by what is compared: computed for its own pixel, or interpolated between vertices.
#ifdef INTERPOLATED
in vec3 p_interpolated;
in vec2 s_interpolated;

vec4 point_of_fragment(ModuleParams m, uint primitive, vec2 limits) {
  if (!on_screen(m, s_interpolated)) return vec4(0.0);
  return vec4(p_interpolated, gl_FrontFacing ? -1.0 : 1.0);  // rows run downward: what is turned to the viewer winds clockwise
}
#else
vec4 point_of_fragment(ModuleParams m, uint primitive, vec2 limits) {
  return meet(m, primitive, limits, gl_FragCoord.xy);
}
#endif

#ifdef GUARD_BAND
// Whether a pixel of the module's own image lights what viewers see of the screen, or is one of the guard band. The other pixels of the
// image are like the band: their surfaces are there for ambient occlusion, and nowhere else.
bool is_seen_or_band(ModuleParams m, vec2 pixel) {
  vec2 from_border = min(pixel, m.screen.zw - pixel);
  if (min(from_border.x, from_border.y) < m.tangential.w) return true;
  return all(lessThanEqual(abs(2.0 * screen_of_pixel(m, pixel)), m.surface.zw));
}
#endif

#ifdef TEXTURED
in vec2 uv;
flat in float texture_layer;
#endif

// Texel of the base colour, white without a picture. Called before anything is discarded: its neighbours' values choose the level.
vec4 texel() {
#ifdef TEXTURED
  return texture(base_color_texture, vec3(uv, texture_layer));
#else
  return vec4(1.0);
#endif
}

#ifdef ALPHA_MASK
// Alpha that a mask is held against: of the finest level, whose holes are the surface's own. Coarser ones would close or eat them away.
float mask_alpha() {
#ifdef TEXTURED
  return textureLod(base_color_texture, vec3(uv, texture_layer), 0.0).a;
#else
  return 1.0;
#endif
}
#endif
