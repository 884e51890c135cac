// Which pixels of a reference image lie at a silhouette, where a renderer may rightly see the one surface or the other.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/reference/caster.h"

namespace lfd::reference {

// A silhouette passes between two pixels that share a side if only one of them shows a surface, if there is none
// halfway between their centres, or if the surface is torn on one of the two halves of the way. It is whole on a half
// if
//   both ends see the same triangle (of a material with a mask: it is also seen at 7 places between them); or
//   the step in depth is what the planes of the two triangles explain: both planes predict a step of at most 2 pitches,
//   the predictions differ by at most half a pitch, and the true step lies between them, within 0.05 pitch; or halving
//   the way again and again, always into the part with the larger gap, meets a gap below 0.01 pitch or two points of
//   one triangle, and never a place without a surface. (So slants and creases, however steep, are no silhouettes.)
// Pitch: the distance of the two lines. A diagonal neighbour is beyond a silhouette if both ways round to it are. What
// is thinner than half a pixel may pass unseen between two points of one triangle.
//
// Returns 1 for each pixel with a surface for which one of its 8 neighbours is beyond a silhouette (so a pixel that is
// not marked lies more than one pixel from any silhouette), else 0; rows from the top. `image` is
// cast_module(intersector, view).
std::vector<std::uint8_t> near_silhouette(const Intersector& intersector, const ModuleView& view,
                                          const HitImage& image);

}  // namespace lfd::reference
