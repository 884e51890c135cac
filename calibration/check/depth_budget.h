// How far before and behind the screen a display stays sharp (design geometry, section 5).
#pragma once

#include <vector>

namespace lfd {

// The spot of one ray at a distance z from the screen: s(z) = s0 + 2 |z| tan(angular resolution / 2).
struct DepthBudget {
  double spot_on_screen_m = 0;        // s0: the width of a pixel
  double angular_resolution_rad = 0;  // the angle between neighbouring rays of one screen point
  double doubled_at_m = 0;            // |z| where s(z) = 2 s0

  struct Spot {
    double distance_m = 0, spot_m = 0;
  };
  std::vector<Spot> spots;  // for distances of a 1, 2, 5 series, and the screen itself

  double spot_m(double distance_m) const;
};

// Distances up to `furthest_m`, over two decades. All arguments > 0.
DepthBudget depth_budget(double spot_on_screen_m, double angular_resolution_rad, double furthest_m);

}  // namespace lfd
