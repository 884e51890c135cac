// How much two 8-bit pictures differ, in decibels.
#pragma once

#include "proto/pictures/picture.h"

namespace lfd::reference {

// Peak signal-to-noise ratio of the colours (r, g, b, not alpha) of two pictures of one size, peak 255, one mean square
// error over the three channels. `border_px` pixels along every side are not looked at (something must be left). Equal
// pictures: infinity.
double psnr_db(const Picture8& a, const Picture8& b, int border_px = 0);

}  // namespace lfd::reference
