// What a picture of the stability suite must keep, and which of it one does not.
#pragma once

#include <string>
#include <vector>

#include "bench/reference/truth.h"

namespace lfd::bench {

// 99.9 % of the pixels within 1e-4 of the ROI diagonal, all within 1e-3, coverage different at 0.05 % at most.
struct PictureBounds {
  double median = 1e-5, percent_999 = 1e-4, max = 1e-3;  // over the diagonal of the region of interest
  std::size_t most_far_off = 0;                          // pixels that may be beyond reference::kFarOff
  double mismatch_share = 5e-4;
  double least_compared_share = 0.2;  // of the reference's pixels with a surface: fewer would say nothing
  std::size_t least_compared = 1;     // pixels
  std::string why;                    // the reason, where one of these is not what it is for most pictures
};

// For the table's column of what is expected.
std::string text_of(const PictureBounds& bounds);

// One text for each bound that is broken, with both numbers.
std::vector<std::string> broken_bounds(const reference::Truth& truth, const PictureBounds& bounds);

}  // namespace lfd::bench
