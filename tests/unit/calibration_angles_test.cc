// Angles between emitters and the depth budget: known answers, and the limits of both.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "calibration/check/acceptance.h"
#include "calibration/make.h"
#include "tests/unit/one_module.h"

namespace lfd {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

TEST(CheckAngles, SpacingIsThatOfArithmetic) {
  DisplayCalibration display = one_module();
  display.modules.clear();
  for (const double x : {-1.0, 0.0, 1.0}) display.modules.push_back({{x, 0, -1}, IdealMap{}});
  display.angular_scattering_rad = 1.5 * std::numbers::pi / 4;
  const AngularReport angles = check_angles(display);
  EXPECT_NEAR(angles.from_centre->min_rad, std::numbers::pi / 4, 1e-12);
  EXPECT_NEAR(angles.from_centre->max_rad, std::numbers::pi / 4, 1e-12);
  // From the left border at x = -1: straight behind, one to the right, two to the right.
  EXPECT_NEAR(angles.from_left->max_rad, std::numbers::pi / 4, 1e-12);
  EXPECT_NEAR(angles.from_left->min_rad, std::atan(2) - std::numbers::pi / 4, 1e-12);
  EXPECT_NEAR(angles.from_right->min_rad, angles.from_left->min_rad, 1e-12);
  EXPECT_NEAR(*angles.scattering_over_rule, 1, 1e-12);
  EXPECT_EQ(angles.order, ModuleOrder::kLeftToRight);
  EXPECT_THAT(angles.gaps, IsEmpty());
}

TEST(CheckAngles, GapsAndOrderAreNamed) {
  DisplayCalibration display = *make_display("desk", 12);
  display.modules.erase(display.modules.begin() + 4, display.modules.begin() + 6);
  AngularReport angles = check_angles(display);
  ASSERT_THAT(angles.gaps, SizeIs(1));
  EXPECT_EQ(angles.gaps[0].left_module, 3);
  EXPECT_EQ(angles.gaps[0].right_module, 4);
  std::swap(display.modules[0], display.modules[1]);
  EXPECT_EQ(check_angles(display).order, ModuleOrder::kMixed);
  display = *make_display("desk");
  std::ranges::reverse(display.modules);
  EXPECT_EQ(check_angles(display).order, ModuleOrder::kRightToLeft);
  EXPECT_FALSE(check_angles(one_module()).from_centre);
  display.modules = {one_module().modules[0], one_module().modules[0]};  // one above the other
  EXPECT_FALSE(check_angles(display).from_centre);
}

TEST(CheckAngles, AMissingModuleIsAGapThatIsRefused) {
  DisplayCalibration display = *make_display("desk", 12);
  EXPECT_NEAR(*check_angles(display).gap_over_scattering, 1 / 1.5, 0.01);  // the rule is that of the two in the middle
  display.modules.erase(display.modules.begin() + 5);
  const auto report = check_calibration(display, 0.05, kQuickSampling);
  EXPECT_NEAR(*report.angles.gap_over_scattering, 2 / 1.5, 0.02);
  EXPECT_THAT(missed_limits(report, {}), ElementsAre(HasSubstr("angle between neighbouring emitters: 1.3")));
  EXPECT_FALSE(accept_calibration(display));
  AcceptanceLimits wide;
  wide.gap_over_scattering = 1.4;
  EXPECT_THAT(missed_limits(report, wide), IsEmpty());
  EXPECT_FALSE(check_angles(one_module()).gap_over_scattering);
}

TEST(DepthBudget, DoublesWhereTheFormulaSays) {
  const DepthBudget budget = depth_budget(0.001, 2 * std::atan(0.01), 1.5);
  EXPECT_NEAR(budget.doubled_at_m, 0.05, 1e-15);
  EXPECT_NEAR(budget.spot_m(0.05), 0.002, 1e-15);
  EXPECT_NEAR(budget.spot_m(-0.5), 0.011, 1e-15);
  ASSERT_THAT(budget.spots, SizeIs(7));  // 0, 0.02, 0.05, 0.1, 0.2, 0.5, 1
  EXPECT_EQ(budget.spots.front().distance_m, 0);
  EXPECT_NEAR(budget.spots.back().distance_m, 1, 1e-12);
}

TEST(DepthBudget, IsLimitedOnRequest) {
  const auto report = check_calibration(*make_display("desk"), 0.05, kQuickSampling);
  AcceptanceLimits limits;
  limits.depth_least_m = 1.01 * report.depth->doubled_at_m;
  EXPECT_THAT(missed_limits(report, limits), ElementsAre(HasSubstr("depth: the spot has doubled")));
  limits.depth_least_m = 0.99 * report.depth->doubled_at_m;
  EXPECT_THAT(missed_limits(report, limits), IsEmpty());
}

}  // namespace
}  // namespace lfd
