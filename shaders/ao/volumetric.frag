// volumetric: lines through the ball along the pixel's own line (Loos & Sloan 2010): hidden is the share of their length that lies
// behind the stored surface. A line whose open share is out of bounds takes the complement of its partner on the other side of the
// pixel (Ownby et al. 2010); where both are, half of both counts.
#version 450 core
#include "ao/method.glsl"

layout(std140, binding = BINDING_AO_METHOD) uniform Parameters {
  float least;  // open shares that are believed
  float most;
};

// Open share of the chord of half length `half_m` at an offset; -1 where there is no surface.
float open_share(Spot spot, Disk disk, vec2 offset, float half_m) {
  vec2 pixel = own_place() + disk.pixels_per_m * offset;
  if (any(lessThan(pixel, vec2(0.0))) || any(greaterThanEqual(pixel, vec2(textureSize(positions, 0).xy)))) return -1.0;
  vec4 surface = surface_at(layer, pixel);
  return surface.w == 0.0 ? -1.0 : (half_m - dot(surface.xyz - spot.p, disk.view)) / (2.0 * half_m);
}

bool is_believed(float share) { return share >= least && share <= most; }

float occlusion(Spot spot, float radius) {
  Disk disk = disk_across(spot, radius, 6.28318530718 * noise().x);
  float open = 0.0, whole = 0.0;
  int count = paired_count(spot);
  for (int i = 0; i + 1 < count; i += 2) {
    float half_m = radius * sqrt(max(1.0 - sample_of(i).w * sample_of(i).w, 1e-6));
    vec2 share = vec2(open_share(spot, disk, radius * sample_of(i).xy, half_m), open_share(spot, disk, radius * sample_of(i + 1).xy, half_m));
    bvec2 believed = bvec2(is_believed(share.x), is_believed(share.y));
    float both = believed.x && believed.y ? share.x + share.y : 1.0;  // one and its complement, or twice half
    open += half_m * both;
    whole += 2.0 * half_m;
  }
  return 1.0 - open / whole;
}
