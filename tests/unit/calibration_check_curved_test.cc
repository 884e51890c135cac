// The check of displays with curved screens: angles, conditions, coverage, and light that misses the observers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "calibration/check/acceptance.h"
#include "calibration/check/derivatives.h"
#include "tests/unit/one_module.h"

namespace lfd {
namespace {

using testing::IsEmpty;

// The ideal map of that display as a grid of so many cells.
GridMap grid_of(int columns, int rows) {
  GridNodes nodes{columns + 1, rows + 1, 0, 0, 200.0 / columns, 100.0 / rows, {}};
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      nodes.node.push_back({2.0 * column / columns - 1, 0.5 - 1.0 * row / rows});
    }
  }
  auto map = GridMap::make(std::move(nodes));
  EXPECT_TRUE(map) << map.error().message();
  return *map;
}

// Share of a curved screen's width that rays from `from` (x, z) cross which come within `near_m` of `axis`.
double share_aimed_at(glm::dvec2 from, glm::dvec2 axis, double near_m, double radius_m, double width_m) {
  constexpr int kColumns = 10000;
  int aimed = 0;
  for (int i = 0; i < kColumns; ++i) {
    const double angle = ((i + 0.5) / kColumns - 0.5) * width_m / radius_m;
    const glm::dvec2 at(radius_m * std::sin(angle), radius_m * (std::cos(angle) - 1));
    const glm::dvec2 along = glm::normalize(at - from), to = axis - from;
    aimed += std::abs(along.x * to.y - along.y * to.x) < near_m ? 1 : 0;
  }
  return static_cast<double>(aimed) / kColumns;
}

TEST(CheckOfCurvedScreens, HasAnglesConditionsAndCoverage) {
  for (const double radius : {-4.0, 4.0}) {
    for (const bool arc : {false, true}) {
      DisplayCalibration display = one_module();
      display.optics.observer_distance_m = 3;
      display.optics.screen_radius_m = radius;
      display.optics.observer_arc = arc;
      display.angular_scattering_rad = 0.3;
      display.modules.push_back({{-0.3, 0, -2}, grid_of(16, 8)});
      ASSERT_TRUE(validate(display));
      const auto report = check_calibration(display, 0.2);
      EXPECT_GE(report.all.condition_median, 1);
      EXPECT_LT(report.all.condition_max, 3);
      if (radius < 0 && arc) {
        // The arc is a circle of 1 m about the axis at (0, 4): wider rays miss it.
        EXPECT_NEAR(report.modules[1].coverage, share_aimed_at({-0.3, -2}, {0, 4}, 1, radius, display.screen.width_m),
                    0.03)
            << "a sample in 65 columns";
        EXPECT_THAT(missed_limits(report, {}), testing::Contains(testing::HasSubstr("coverage: ")));
      } else {
        EXPECT_EQ(report.all.coverage, 1);
        EXPECT_THAT(missed_limits(report, {}), IsEmpty());
      }
      // On the screen at its middle, straight before the emitter: as on a planar one.
      display.modules[0].emitter.x = 0;
      EXPECT_NEAR(*condition_at(display, display.modules[0], {0, 0.4999, 0}), 1, 1e-3);
      EXPECT_NEAR(point_before_screen(display.optics, {1, 0}, 0.1).x, (radius + 0.1) * std::sin(1 / radius), 1e-12);
    }
  }
}

}  // namespace
}  // namespace lfd
