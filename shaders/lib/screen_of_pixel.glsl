// Screen point of a pixel, by whatever tells it for the module's kind of map. Needs lib/image_map.glsl. PIXEL_TABLE: some module has a
// table of the screen points of its pixels, far off the screen where there is none.

#ifdef PIXEL_TABLE
layout(binding = UNIT_PIXEL_TABLE) uniform sampler2DArray pixel_table;
#endif

vec2 screen_of_pixel(ModuleParams m, vec2 pixel) {
#ifdef PIXEL_TABLE
  if (m.observer.w >= 0.0) return texelFetch(pixel_table, ivec3(pixel, int(m.observer.w)), 0).xy;
#endif
  return screen_from_image(m, pixel);
}
