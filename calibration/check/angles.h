// The directions from which light reaches the screen: how evenly the emitters divide the field of view.
//
// Angles are horizontal ones; with a conical diffuser they are rho_in of design geometry, section 5, which is about the
// angle in the slanted plane through the emitter: that is what its angular scattering spreads.
#pragma once

#include <optional>
#include <vector>

#include "calibration/display.h"

namespace lfd {

// Angles between neighbouring emitters, radians.
struct AngularSpacing {
  double min_rad = 0, median_rad = 0, max_rad = 0;
};

// Neighbouring modules that stand more than twice the median apart.
struct AngularGap {
  int left_module = 0, right_module = 0;
  double angle_rad = 0;
};

enum class ModuleOrder { kLeftToRight, kRightToLeft, kMixed };

struct AngularReport {
  // Seen from the middle of the screen and of its left and right border. Emitters in one direction (1e-9 rad) count as
  // one; absent where there are fewer than two directions.
  std::optional<AngularSpacing> from_centre, from_left, from_right;
  ModuleOrder order = ModuleOrder::kLeftToRight;  // of the file's modules, as a viewer sees their emitters
  std::vector<AngularGap> gaps;                   // seen from the centre, left to right
  // The calibration's angular scattering, and that over the rule of thumb (calibration/make.h); absent where the rule
  // does not apply.
  double scattering_rad = 0;
  std::optional<double> scattering_over_rule;
  // The largest of all angles between neighbours, from the centre and both borders, over the angular scattering: what
  // the diffuser has to bridge. Halfway between such two emitters each has exp(-(1.11741 / 2 x this)^2) of its light
  // straight ahead (design geometry, section 5). Absent where there are fewer than two directions.
  std::optional<double> gap_over_scattering;
};

// `display` is valid.
AngularReport check_angles(const DisplayCalibration& display);

// The direction of a module's emitter from a point: 0 straight behind it, positive to the right.
struct EmitterDirection {
  int module = 0;
  double angle_rad = 0;
};

// Seen from a point of the screen, left to right; one of those that agree within 1e-9 rad.
std::vector<EmitterDirection> emitter_directions(const DisplayCalibration& display, ScreenPoint s);

}  // namespace lfd
