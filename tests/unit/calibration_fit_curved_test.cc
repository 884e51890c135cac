// Fits of curved screens: maps are recovered from observations with noise, outliers and areas that nobody saw.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "calibration/make.h"
#include "tests/unit/fit_truths.h"

namespace lfd {
namespace {

constexpr int kModules = 3;

SimulationOptions as_a_camera_sees() {
  SimulationOptions options;  // 24 x 18 points, 1 % outliers, 5 % of each image missing
  options.noise_px = kNoise_px;
  return options;
}

// The radius of the truth; the start believes it to be 5 % larger.
class FitOfCurvedDisplays : public testing::TestWithParam<double> {
 protected:
  DisplayCalibration truth_ = *curved(perturbed(*make_display("desk", kModules), 5), GetParam(), false);
  DisplayCalibration start_ = *curved(*make_display("desk", kModules), GetParam(), false);

  void SetUp() override { start_.optics.screen_radius_m *= 1.05; }
};

TEST_P(FitOfCurvedDisplays, RecoversPinholesAndTheRadius) {
  const auto simulated = *simulate_observations(truth_, as_a_camera_sees());
  const auto fitted = fit_display(start_, simulated.observations);
  ASSERT_TRUE(fitted) << fitted.error().message();
  expect_recovered(truth_, *fitted);
  EXPECT_EQ(lines_of(fitted->outliers), outlier_lines(simulated));
  for (const ModuleFit& module : fitted->modules) EXPECT_FALSE(module.is_grid);
  EXPECT_FALSE(fitted->radius_is_held);
  const double off_m = std::abs(fitted->display.optics.screen_radius_m - GetParam());
  EXPECT_LT(off_m, 4 * fitted->radius_sd_m);
  EXPECT_LT(fitted->radius_sd_m, 0.02 * std::abs(GetParam()));
}

TEST_P(FitOfCurvedDisplays, RecoversGrids) {
  const DisplayCalibration truth = *measured(truth_, 41, 31, 2, 1);
  const auto simulated = *simulate_observations(truth, as_a_camera_sees());
  const auto fitted = fit_display(start_, simulated.observations);
  ASSERT_TRUE(fitted) << fitted.error().message();
  expect_grids_recovered(truth, *fitted, simulated.observations);
  EXPECT_EQ(lines_of(fitted->outliers), outlier_lines(simulated));
  for (const ModuleFit& module : fitted->modules) EXPECT_TRUE(module.is_grid);
  // Warps look like curvature: fitted to them the radius would be off by 20 to 30 %.
  EXPECT_TRUE(fitted->radius_is_held);
  EXPECT_EQ(fitted->display.optics.screen_radius_m, start_.optics.screen_radius_m);
  EXPECT_EQ(fitted->radius_sd_m, 0);
}

INSTANTIATE_TEST_SUITE_P(Radii, FitOfCurvedDisplays, testing::Values(1.0, -1.5),
                         [](const auto& test) { return test.param > 0 ? "Convex" : "Concave"; });

}  // namespace
}  // namespace lfd
