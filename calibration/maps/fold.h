// Whether a cell of a measured grid has folded: the sign of its patch's Jacobian, proven by bounds.
#pragma once

#include "calibration/maps/bicubic_patch.h"

namespace lfd {

// Whether the determinant of the patch's Jacobian has the sign of `orientation` (1 or -1) all over the closed patch.
// True is proven: the determinant is a polynomial of degree 5 along a and along b, which lies between its least and
// its greatest Bezier coefficient; where these do not tell, it is halved. False: somewhere it has the other sign, or
// less than 1/3000 of its largest coefficient, or it is 0 to rounding.
bool keeps_orientation(const BicubicPatch& patch, double orientation);

}  // namespace lfd
