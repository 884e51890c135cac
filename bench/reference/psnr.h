// How much two 8-bit pictures differ, in decibels.
#pragma once

#include <cstdint>
#include <span>

#include "calibration/spaces/pixel.h"

namespace lfd::reference {

// Peak signal-to-noise ratio of the colours (r, g, b, not alpha) of two RGBA pictures of one size, peak 255, one mean
// square error over the three channels. `border_px` pixels along every side are not looked at (something must be left).
// Equal pictures: infinity.
double psnr_db(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b, ImageSize size, int border_px = 0);

}  // namespace lfd::reference
