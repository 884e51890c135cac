// pyramid_hbao: along random directions steps that grow threefold with each level of the pyramid; in each direction the surface that
// hides most counts, (1 - r / R) n.v / |v| (Pyramid HBAO, 2021, equation 8).
#version 450 core
#include "ao/method.glsl"

layout(std140, binding = BINDING_AO_METHOD) uniform Parameters {
  float levels;      // of the pyramid, the full picture counted
  float directions;
  float steps;       // along each direction on each level
};

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
    float step_px = 1.0 + own.y, reach_px = 0.0, most = 0.0, horizon = 0.0;  // its sine above the tangent plane
    int size = 1;
    for (int level = 0; level < int(levels); ++level) {
      for (int j = 0; j < int(steps); ++j) {
        reach_px += step_px;
        ivec2 pixel = ivec2(floor(own_place() + reach_px * direction));
        vec4 surface = any(lessThan(pixel, ivec2(0))) ? vec4(0.0) : surface_of_level(level, pixel / size);
        vec3 v = surface.xyz - spot.p;
        float r = length(v);
        if (surface.w == 0.0 || r == 0.0) continue;
        float hidden = max(0.0, 1.0 - r / radius) * dot(spot.normal, v) / r;
        if (hidden > most) horizon = dot(spot.normal, v) / r;
        most = max(most, hidden);
      }
      step_px *= 3.0;
      size *= 3;
    }
    sum += most;
    vec3 across = cos(angle) * disk.x + sin(angle) * disk.y, tangent = across - dot(spot.normal, across) / facing * disk.view;
    float share = 1.0 / dot(tangent, tangent);  // of the turn about the normal that one direction of the disk stands for
    mat2x3 slice = share * mat2x3(normalize(tangent), spot.normal);
    vec2 all = arc_above(0.0), open = horizon > 0.0 ? all - most / horizon * (all - arc_above(horizon)) : all;
    see(slice * all, slice * open, share, share * (1.0 - most));
  }
  return sum / float(count);
}
