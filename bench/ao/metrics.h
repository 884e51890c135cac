// How far one picture of openness (1 - ambient occlusion) is from another.
#pragma once

#include <cstddef>
#include <vector>

#include "calibration/spaces/pixel.h"

namespace lfd::bench {

// Openness of every pixel, rows from the top; negative where there is no surface.
struct Openness {
  ImageSize size;
  std::vector<float> value;
};

struct AoDifference {
  double mae = 0;           // mean absolute error over pixels with a surface in both
  double mean = 0;          // mean of other minus reference over the same pixels
  double ssim = 1;          // mean over all windows
  std::size_t pixels = 0;   // that were compared
  std::size_t windows = 0;  // of 11 x 11 pixels, all with a surface in both; none: ssim is 1 and says nothing
};

// Structural similarity over uniform windows of 11 x 11 pixels with population moments, a range Q of 1, k1 = 0.001 and
// k2 = 0.03, as printed in the paper of Pyramid HBAO (2021, equation 10). Both pictures are of one size.
AoDifference difference(const Openness& reference, const Openness& other);

}  // namespace lfd::bench
