// How far a rendered picture of positions is from the reference: the numbers and the bounds that they must keep.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bench/reference/caster.h"
#include "proto/pictures/picture.h"

namespace lfd::reference {

// An error, over the ROI diagonal, that no pixel should have.
inline constexpr double kFarOff = 1e-3;

// Errors are distances in the world over the diagonal of the region of interest. Percentiles are by nearest rank; all 0
// where nothing was compared. A position that is not finite has the error infinity.
struct Truth {
  std::size_t in_both = 0;            // pixels with a surface in both pictures
  std::size_t near_silhouette = 0;    // of those: near a silhouette of the reference, not compared
  std::size_t compared = 0;           // of those: the others
  std::size_t only_in_reference = 0;  // pixels with a surface in only one, wherever they lie
  std::size_t only_in_rendered = 0;
  std::size_t far_off = 0;            // of those: with an error above kFarOff
  double median = 0, percent_99 = 0, percent_999 = 0, max = 0;  // 999: the 99.9 % percentile
  PixelIndex worst;                                             // where max was found
  double mismatch_share = 0;  // pixels with a surface in only one, over those with one in any; 0 where none has
};

// `rendered` is a position buffer as it is written to files: world position minus `position_origin`, alpha 1 where
// there is a surface, else 0. `near_silhouette` is that of silhouette.h for `reference`. All three are of one size.
Truth compare(const HitImage& reference, std::span<const std::uint8_t> near_silhouette, const PictureF& rendered,
              Point3<World> position_origin, double roi_diagonal_m);

// What a renderer must keep.
struct TruthBounds {
  double median = 1e-5, percent_99 = 1e-4, max = 1e-3;
  double mismatch_share = 3e-3;
  double least_compared_share = 0.2;  // of the reference's pixels with a surface: fewer would say nothing
};

// One line for each bound that is broken, with both numbers. None: the picture is true.
std::vector<std::string> broken_bounds(const Truth& truth, const TruthBounds& bounds = {});

}  // namespace lfd::reference
