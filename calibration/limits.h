// How large and how small the numbers of a display may be, for single precision on the GPU to draw it right. Pictures
// at the ends of screen sides, observers, emitters and focal lengths are drawn by bench/stability; radii from 2 mm.
#pragma once

#include <cmath>
#include <string>

#include "base/log.h"
#include "base/result.h"

namespace lfd {

struct Limits {
  double least, most;  // of the magnitude
};

inline constexpr Limits kScreenSide_m{1e-3, 1e3};
inline constexpr Limits kScreenRadius_m{1e-3, 1e12};
inline constexpr Limits kObserverDistance_m{1e-3, 1e6};
inline constexpr Limits kEmitterDistance_m{1e-6, 1e6};  // behind the screen
inline constexpr double kLeastCurvedEmitter = 0.02;     // likewise, on a curved screen: over the screen's width
inline constexpr double kMostConicalHeight = 300;       // of observers before a conical diffuser, over their distance
inline constexpr Limits kPlace_m{0, 1e6};               // every other coordinate in physical space
inline constexpr Limits kScattering_rad{1e-6, 6.3};     // the virtual display's alone: a whole turn
inline constexpr Limits kFocalLength_px{1e-3, 1e7};
inline constexpr Limits kPlace_px{0, 1e7};        // of principal points and grids: pixels are still told apart
inline constexpr Limits kGridStep_px{1e-3, 1e7};  // likewise; grids are inverted in double
inline constexpr Limits kDistortion{0, 1e6};

// How far a unit quaternion's length may be from 1: that of four digits after the point is off by up to 1e-4. It is
// normalised wherever it is used; one that is farther away has a wrong number in it.
inline constexpr double kUnitLengthError = 2e-4;

// Regions of interest (calibration/spaces/roi.h).
inline constexpr Limits kRoiWorldSize_m{1e-9, 1e12};
inline constexpr Limits kRoiPhysicalSize_m{1e-9, 1e6};
inline constexpr double kMostRoiRatio = 1e7;  // of the longest axis of a box to its shortest
inline constexpr double kFarthestRoi = 1e10;  // diagonals from the world's origin: 1e-6 of the diagonal is left there

// How many diagonals of the world box its physical box is across along the axis that is magnified most: what single
// precision loses in physical space comes back as so much of the world's diagonal.
inline constexpr double kMostRoiMagnification = 1e4;

// "`field`: 1e+39; 0.001 to 1000 are possible". A number that is not finite has no magnitude within any limits.
inline Status check_magnitude(const std::string& field, double value, Limits limits) {
  if (std::abs(value) >= limits.least && std::abs(value) <= limits.most) return {};
  return Error(
      limits.least > 0
          ? fmt::format("{}: {}; magnitudes of {:g} to {:g} are possible", field, value, limits.least, limits.most)
          : fmt::format("{}: {}; magnitudes of up to {:g} are possible", field, value, limits.most));
}

}  // namespace lfd
