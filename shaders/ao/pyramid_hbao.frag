// pyramid_hbao: along random directions steps that grow threefold with each level of the pyramid; in each direction the surface that
// hides most counts, (1 - r / R) n.v / |v| (Pyramid HBAO, 2021, equation 8).
#version 450 core
#include "ao/method.glsl"

layout(std140, binding = BINDING_AO_METHOD) uniform Parameters {
  float levels;      // of the pyramid, the full picture counted; at most 5
  float directions;
  float steps;       // along each direction on each level
};

// What a surface hides of the direction it lies in, and the sine of its height above the tangent plane.
vec2 hidden_by(Spot spot, float radius, vec4 surface) {
  vec3 v = surface.xyz - spot.p;
  float r = length(v);
  if (surface.w == 0.0 || r == 0.0) return vec2(0.0);
  return vec2(max(0.0, 1.0 - r / radius) * dot(spot.normal, v) / r, dot(spot.normal, v) / r);
}

// The most that is hidden along a direction on one level, from reach_px on. What the pyramid's factor to the level's power is must be
// known when this is compiled: rasterisers divide by other numbers slowly, and compute both sides of conditions.
#define MOST_ON_LEVEL(level, power)                                                                                     \
  if (level < int(levels)) {                                                                                            \
    ivec2 size = (textureSize(positions, 0).xy + power - 1) / power;                                                    \
    for (int j = 0; j < int(steps); ++j) {                                                                              \
      reach_px += step_px;                                                                                              \
      ivec2 pixel = ivec2(floor(own_place() + reach_px * direction));                                                   \
      bool is_beside = any(lessThan(pixel, ivec2(0)));                                                                  \
      vec4 surface = is_beside ? vec4(0.0) : level == 0 ? surface_of(pixel) : surface_of_level(level, pixel / power, size); \
      vec2 hidden = hidden_by(spot, radius, surface);                                                                   \
      if (hidden.x > most) horizon = hidden.y;                                                                          \
      most = max(most, hidden.x);                                                                                       \
    }                                                                                                                   \
    step_px *= 3.0;                                                                                                     \
  }

float occlusion(Spot spot, float radius) {
  vec3 random = noise();
  Disk disk = disk_across(spot, radius, 0.0);
  float facing = max(dot(spot.normal, disk.view), 1e-3);
  float sum = 0.0;
  int count = count_at(spot, int(directions));
  for (int i = 0; i < count; ++i) {
    vec2 own = fract(random.xy + float(i + 1) * vec2(0.75487766624669, 0.56984029099805));  // of each direction (R2 sequence)
    float angle = 6.28318530718 * own.x;
    vec2 along = disk.pixels_per_m * vec2(cos(angle), sin(angle));
    vec2 direction = along / max(length(along), 1e-30);
    float step_px = 1.0 + own.y, reach_px = 0.0, most = 0.0, horizon = 0.0;  // horizon: its sine above the tangent plane
    MOST_ON_LEVEL(0, 1)
    MOST_ON_LEVEL(1, 3)
    MOST_ON_LEVEL(2, 9)
    MOST_ON_LEVEL(3, 27)
    MOST_ON_LEVEL(4, 81)
    sum += most;
    vec3 across = cos(angle) * disk.x + sin(angle) * disk.y, tangent = across - dot(spot.normal, across) / facing * disk.view;
    float share = 1.0 / dot(tangent, tangent);  // of the turn about the normal that one direction of the disk stands for
    mat2x3 slice = share * mat2x3(normalize(tangent), spot.normal);
    vec2 all = arc_above(0.0), open = horizon > 0.0 ? all - most / horizon * (all - arc_above(horizon)) : all;
    see(slice * all, slice * open, share, share * (1.0 - most));
  }
  return sum / float(count);
}
