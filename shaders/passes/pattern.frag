// Test patterns in place of pictures, as the bytes that modules are fed: no transfer is applied, and no colour corrected.
#version 450 core
#include "shared/bindings.glsl"
#include "shared/module_params.glsl"
#include "shared/pattern_params.glsl"
#include "lib/optics.glsl"
#include "lib/image_map.glsl"
#include "lib/module_number.glsl"
#include "lib/screen_of_pixel.glsl"

layout(std140, binding = BINDING_MODULES) uniform Modules { ModuleParams modules[MODULES_PER_NODE]; };
layout(std140, binding = BINDING_PATTERNS) uniform Patterns { PatternParams patterns[MODULES_PER_NODE]; };

flat in int layer;
layout(location = 0) out vec4 out_color;

const vec3 black = vec3(0.0), middle_color = vec3(1.0, 0.0, 0.0);
const vec2 nowhere = vec2(1e30);

// Within half a pixel, and a little more: from one pixel to the next maps are nearly straight.
const float half_a_pixel = 0.52;

bool is_on_border(ivec2 pixel, ivec2 size) { return any(equal(pixel, ivec2(0))) || any(equal(pixel, size - 1)); }

// The top left corner is filled, so that pictures that are flipped or turned show it elsewhere.
bool is_on_number_or_frame(int number, ivec2 size, ivec2 pixel) {
  bool in_corner = pixel.x + pixel.y <= max(3, min(size.x, size.y) / 6);
  return in_corner || is_on_border(pixel, size) || is_on_number(number, size, pixel);
}

// Lines are a pixel wide; in the middle of an even number of pixels there are two.
vec3 grid_in_image(vec3 color, int spacing, ivec2 size, ivec2 pixel) {
  if (is_on_border(pixel, size)) return color;
  if (any(lessThanEqual(abs(2 * pixel + 1 - size), ivec2(1)))) return middle_color;
  return any(equal(pixel % spacing, ivec2(0))) ? color : black;
}

// Screen point of a pixel's centre. A homography has none on and behind its horizon.
vec2 screen_point(ModuleParams m, vec2 pixel) {
  if (!in_image(m, pixel)) return nowhere;
  if (m.observer.w < 0.0 && dot(m.screen_from_image_2.xyz, vec3(pixel, 1.0)) <= 0.0) return nowhere;
  return screen_of_pixel(m, pixel);
}

// How far the next pixel's screen point is, along both axes; where there is none, that of the one before.
vec2 to_next(ModuleParams m, vec2 pixel, vec2 s, vec2 direction) {
  vec2 next = screen_point(m, pixel + direction);
  if (!on_screen(m, next)) next = screen_point(m, pixel - direction);
  return on_screen(m, next) ? abs(next - s) : vec2(0.0);
}

// The border's line lies inside of it, since pixels beyond have no screen point on some maps.
vec3 grid_on_screen(vec3 color, float spacing, ModuleParams m, vec2 pixel) {
  vec2 s = screen_point(m, pixel);
  if (!on_screen(m, s)) return black;
  vec2 reach = half_a_pixel * (to_next(m, pixel, s, vec2(1.0, 0.0)) + to_next(m, pixel, s, vec2(0.0, 1.0)));
  if (any(lessThanEqual(0.5 * m.screen.xy - abs(s), 2.0 * reach))) return color;
  if (any(lessThanEqual(abs(s), reach))) return middle_color;
  vec2 from_line = abs(s - spacing * round(s / spacing));
  return any(lessThanEqual(from_line, reach)) ? color : black;
}

bool is_on_square_in_image(int side, ivec2 pixel) { return (pixel.x / side + pixel.y / side) % 2 == 0; }

bool is_on_square_on_screen(float side, ModuleParams m, vec2 pixel) {
  vec2 s = screen_point(m, pixel);
  vec2 square = floor(s / side);
  return on_screen(m, s) && mod(square.x + square.y, 2.0) == 0.0;
}

vec3 shown(PatternParams pattern, ModuleParams m, vec2 pixel) {
  ivec2 at = ivec2(pixel), size = ivec2(m.screen.zw);
  float spacing = pattern.what.y;
  bool of_screen = pattern.what.z == 1.0;
  vec3 color = pattern.color.rgb;
  switch (int(pattern.what.x)) {
    case PATTERN_NUMBER:
      return is_on_number_or_frame(int(m.tangential.z), size, at) ? color : black;
    case PATTERN_GRID:
      return of_screen ? grid_on_screen(color, spacing, m, pixel) : grid_in_image(color, int(spacing), size, at);
    case PATTERN_CHECKER:
      return (of_screen ? is_on_square_on_screen(spacing, m, pixel) : is_on_square_in_image(int(spacing), at)) ? color : black;
    case PATTERN_SOLID:
      return color;
    default:
      return black;
  }
}

void main() {
  vec3 drive = shown(patterns[layer], modules[layer], gl_FragCoord.xy);
  out_color = vec4(floor(drive * 255.0 + 0.5) / 255.0, 1.0);
}
