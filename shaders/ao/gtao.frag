// gtao: slices through the pixel's own line. In each the horizons to both sides give the cosine-weighted share of the arc between them
// about the projected normal (Jimenez et al. 2016, section 4); or surfaces with a thickness cover sectors of that half circle, which
// are laid out so that each is worth the same (bitmask, Therrien et al. 2023).
#version 450 core
#include "ao/method.glsl"

layout(std140, binding = BINDING_AO_METHOD) uniform Parameters {
  float slices;
  float steps;
  float falloff;
  float bitmask;
  float thickness;  // radii
};

const float pi = 3.14159265359;

// Integral of the arc from the projected normal, gamma from the viewers, to a horizon h (equation 7).
float arc(float h, float gamma) { return 0.25 * (-cos(2.0 * h - gamma) + cos(gamma) + 2.0 * h * sin(gamma)); }

// Surfaces keep all of their weight up to (1 - falloff) R and lose it until R.
float weight_of(float r, float radius) { return clamp((1.0 - r / radius) / falloff, 0.0, 1.0); }

// Above the tangent plane by more than a half float of its normal is off. (Pixels lie beside the slice, where a slanted plane is higher.)
bool is_above(Spot spot, vec3 v, float r) { return dot(v, spot.normal) > 0.002 * r; }

// Cosine to the viewers of the horizon on one side (direction in the disk), from that of the tangent plane upward.
float horizon(Spot spot, Disk disk, vec2 direction, float tangent, float radius, float jitter) {
  float highest = tangent;
  for (int j = 0; j < int(steps); ++j) {
    vec4 surface = surface_at_offset(disk, radius * ((float(j) + jitter) / steps) * direction);
    vec3 v = surface.xyz - spot.p;
    float r = length(v);
    if (surface.w == 0.0 || !is_above(spot, v, r)) continue;
    highest = max(highest, mix(tangent, dot(v, disk.view) / r, weight_of(r, radius)));
  }
  return highest;
}

// What the whole half circle about the projected normal is worth.
float half_circle(float gamma) { return cos(gamma) + gamma * sin(gamma); }

// Where an angle from the viewers lies in it, 0 to 1, so that equal parts are worth the same.
float place_in_half(float angle, float gamma) {
  float h = clamp(angle, gamma - 0.5 * pi, gamma + 0.5 * pi);
  return (arc(gamma - 0.5 * pi, gamma) + sign(h) * arc(h, gamma)) / half_circle(gamma);
}

// Sectors that the surfaces on one side cover; side is 1 or -1.
uint sectors(Spot spot, Disk disk, vec2 direction, float side, float gamma, float radius, float jitter) {
  uint mask = 0u;
  for (int j = 0; j < int(steps); ++j) {
    vec4 surface = surface_at_offset(disk, radius * ((float(j) + jitter) / steps) * side * direction);
    vec3 v = surface.xyz - spot.p;
    float r = length(v);
    if (surface.w == 0.0 || r > radius || !is_above(spot, v, r)) continue;
    vec3 back = v - thickness * radius * disk.view;
    vec2 ends = vec2(place_in_half(side * acos(clamp(dot(v, disk.view) / r, -1.0, 1.0)), gamma),
                     place_in_half(side * acos(clamp(dot(back, disk.view) / length(back), -1.0, 1.0)), gamma));
    float low = min(ends.x, ends.y), high = max(ends.x, ends.y);
    int first = int(floor(32.0 * low + 0.5)), last = int(floor(32.0 * high + 0.5));  // whose middles are covered
    if (last > first) mask |= (last - first >= 32 ? 0xffffffffu : (1u << uint(last - first)) - 1u) << uint(first);
  }
  return mask;
}

// place_in_half() backward, by bisection.
float angle_of_place(float place, float gamma) {
  float low = gamma - 0.5 * pi, high = gamma + 0.5 * pi;
  for (int i = 0; i < 16; ++i) {
    float middle = 0.5 * (low + high);
    if (place_in_half(middle, gamma) < place) low = middle; else high = middle;
  }
  return 0.5 * (low + high);
}

// Integral of the directions between the viewers and a horizon, along the slice (x) and to the viewers (y), weighed as in arc().
vec2 directions_of_arc(float h, float gamma) {
  float side = h < 0.0 ? -1.0 : 1.0, sine = sin(abs(h)), cosine = cos(h), sine3 = sine * sine * sine, cosine3 = cosine * cosine * cosine;
  return vec2(side * (cos(gamma) * sine3 + side * sin(gamma) * (cosine3 - 3.0 * cosine + 2.0)),
              cos(gamma) * (1.0 - cosine3) + side * sin(gamma) * sine3) / 3.0;
}

// The same of the half circle up to the first so many sectors, but for a constant.
vec2 directions_up_to(int sector, float gamma) {
  float angle = angle_of_place(float(sector) / 32.0, gamma);
  return sign(angle) * directions_of_arc(angle, gamma);
}

// The same of covered sectors, run by run.
vec2 directions_of_sectors(uint mask, float gamma) {
  vec2 sum = vec2(0.0);
  while (mask != 0u) {
    int first = findLSB(mask), end = findLSB(~(mask | ((1u << uint(first)) - 1u)));
    if (end < 0) end = 32;
    sum += directions_up_to(end, gamma) - directions_up_to(first, gamma);
    mask = end == 32 ? 0u : mask >> uint(end) << uint(end);
  }
  return sum;
}

float occlusion(Spot spot, float radius) {
  vec3 random = noise();
  int count = count_at(spot, int(slices));
  float turn = pi / float(count);  // from one slice to the next
  Disk disk = disk_across(spot, radius, turn * random.x);
  float open = 0.0, whole = 0.0;
  for (int i = 0; i < count; ++i) {
    float angle = turn * float(i);
    vec2 direction = vec2(cos(angle), sin(angle));
    vec3 along = direction.x * disk.x + direction.y * disk.y;
    vec2 projected = vec2(dot(spot.normal, along), dot(spot.normal, disk.view));  // of the normal into the slice
    float strength = length(projected);
    if (strength == 0.0) continue;
    float gamma = clamp(atan(projected.x, projected.y), -0.5 * pi, 0.5 * pi);
    float all = strength * half_circle(gamma);
    whole += all;
    mat2x3 slice = strength * mat2x3(along, disk.view);
    vec2 ends = directions_of_arc(gamma - 0.5 * pi, gamma) + directions_of_arc(gamma + 0.5 * pi, gamma);
    if (bitmask != 0.0) {
      uint mask = sectors(spot, disk, direction, 1.0, gamma, radius, random.y) |
                  sectors(spot, disk, direction, -1.0, gamma, radius, random.z);
      float left = all * (1.0 - float(bitCount(mask)) / 32.0);
      open += left;
#ifdef BENT
      see(slice * ends, slice * (ends - directions_of_sectors(mask, gamma)), all, left);
#endif
      continue;
    }
    float front = acos(clamp(horizon(spot, disk, direction, cos(gamma + 0.5 * pi), radius, random.y), -1.0, 1.0));
    float back = -acos(clamp(horizon(spot, disk, -direction, cos(gamma - 0.5 * pi), radius, random.z), -1.0, 1.0));
    float left = strength * (arc(front, gamma) + arc(back, gamma));
    open += left;
    see(slice * ends, slice * (directions_of_arc(back, gamma) + directions_of_arc(front, gamma)), all, left);
  }
  return whole == 0.0 ? 0.0 : 1.0 - open / whole;
}
