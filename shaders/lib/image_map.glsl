// The calibrated map of a module, screen <-> image: GLSL twins of calibration/maps and rendernode/geometry/warp_table.h. Needs
// lib/optics.glsl. NO_PINHOLE: no module has such a map.

#ifdef WARP_TABLE
layout(binding = UNIT_WARP_TABLE) uniform sampler2DArray warp_table;

// What the base homography misses, bilinear between nodes; that of the border beyond it.
vec2 warp_residual(ModuleParams m, vec2 s) {
  vec2 place = clamp((s - m.pinhole_0.xy) * m.pinhole_0.zw, vec2(0.0), m.pinhole_1.xy - 1.0);
  ivec2 first = min(ivec2(place), ivec2(m.pinhole_1.xy) - 2);
  vec2 share = place - vec2(first);
  ivec3 at = ivec3(first, int(m.pinhole_1.z));
  vec2 lower = mix(texelFetch(warp_table, at, 0).xy, texelFetch(warp_table, at + ivec3(1, 0, 0), 0).xy, share.x);
  vec2 upper = mix(texelFetch(warp_table, at + ivec3(0, 1, 0), 0).xy, texelFetch(warp_table, at + ivec3(1, 1, 0), 0).xy, share.x);
  return mix(lower, upper, share.y);
}
#endif

vec2 distort(ModuleParams m, vec2 a) {
  float r2 = dot(a, a);
  float radial = 1.0 + r2 * (m.distortion.x + r2 * (m.distortion.y + r2 * m.distortion.z));
  float p1 = m.tangential.x, p2 = m.tangential.y;
  return a * radial + vec2(2.0 * p1 * a.x * a.y + p2 * (r2 + 2.0 * a.x * a.x), p1 * (r2 + 2.0 * a.y * a.y) + 2.0 * p2 * a.x * a.y);
}

#ifndef NO_PINHOLE
vec3 image_of_pinhole(ModuleParams m, vec2 s) {
  vec4 p = vec4(surface_point(m, s), 1.0);
  vec3 q = vec3(dot(m.pinhole_0, p), dot(m.pinhole_1, p), dot(m.pinhole_2, p));
  vec2 a = q.xy / q.z;
  if (!(q.z > 0.0)) return vec3(0.0);
  float r2 = dot(a, a);
  vec2 inner = r2 < m.distortion.w ? a : a * sqrt(m.distortion.w / r2);
  return vec3(m.focal_principal.xy * (distort(m, inner) + (a - inner)) + m.focal_principal.zw, r2 < m.distortion.w ? 1.0 : 0.5);
}
#endif

// Pixel (xy) of a screen point; z is 1 where it has one, 0 where not. Points beside the image or the screen have values all the same;
// beyond the radius where a distortion turns back it goes on straight (z is 0.5): no pixel, but a place for a triangle's corner.
vec3 image_from_screen(ModuleParams m, vec2 s) {
#ifndef NO_PINHOLE
  if (m.emitter.w == 1.0) return image_of_pinhole(m, s);
#endif
  vec3 q = vec3(dot(m.image_from_screen_0.xyz, vec3(s, 1.0)), dot(m.image_from_screen_1.xyz, vec3(s, 1.0)),
                dot(m.image_from_screen_2.xyz, vec3(s, 1.0)));
  if (!(q.z > 0.0)) return vec3(0.0);
#ifdef WARP_TABLE
  if (m.emitter.w == 2.0) return vec3(q.xy / q.z + warp_residual(m, s), 1.0);
#endif
  return vec3(q.xy / q.z, 1.0);
}

bool on_screen(ModuleParams m, vec2 s) { return all(lessThanEqual(abs(2.0 * s), m.screen.xy)); }

bool in_image(ModuleParams m, vec2 pixel) {
  return all(greaterThanEqual(pixel, vec2(0.0))) && all(lessThan(pixel, m.screen.zw));
}

// image(): pixel and depth of a physical point; w is 1 where it has an image, else 0.
vec4 image_from_physical(ModuleParams m, vec3 p) {
  if (!is_curved(m) && (!(p.z > m.emitter.z) || !(p.z < m.observer.y))) return vec4(0.0);
  vec4 s = screen_from_physical(m, p);
  if (!(s.z > 0.0) || !on_screen(m, s.xy)) return vec4(0.0);
  vec3 pixel = image_from_screen(m, s.xy);
  if (pixel.z != 1.0 || !in_image(m, pixel.xy)) return vec4(0.0);
  return vec4(pixel.xy, s.w, 1.0);
}

// Screen point of a pixel through the homography; pinholes and tables read their pixel table instead.
vec2 screen_from_image(ModuleParams m, vec2 pixel) {
  vec3 p = vec3(pixel, 1.0);
  vec3 q = vec3(dot(m.screen_from_image_0.xyz, p), dot(m.screen_from_image_1.xyz, p), dot(m.screen_from_image_2.xyz, p));
  return q.xy / q.z;
}
