// The budget as a formula and as a table.
#include "calibration/check/depth_budget.h"

#include <algorithm>
#include <cmath>

namespace lfd {

double DepthBudget::spot_m(double distance_m) const {
  return spot_on_screen_m + 2 * std::abs(distance_m) * std::tan(angular_resolution_rad / 2);
}

DepthBudget depth_budget(double spot_on_screen_m, double angular_resolution_rad, double furthest_m) {
  DepthBudget budget{
      spot_on_screen_m, angular_resolution_rad, spot_on_screen_m / (2 * std::tan(angular_resolution_rad / 2)), {}};
  budget.spots.push_back({0, spot_on_screen_m});
  const int last_decade = static_cast<int>(std::floor(std::log10(furthest_m)));
  for (int decade = last_decade - 2; decade <= last_decade; ++decade) {
    for (const double step : {1.0, 2.0, 5.0}) {
      const double distance = step * std::pow(10, decade);
      if (distance > furthest_m || distance < furthest_m / 100) continue;
      budget.spots.push_back({distance, budget.spot_m(distance)});
    }
  }
  return budget;
}

}  // namespace lfd
