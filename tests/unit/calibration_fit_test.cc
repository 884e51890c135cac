// Fitting calibrations to observations: the truth is recovered from what was simulated of it.
#include "calibration/fit/fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "base/log.h"
#include "calibration/make.h"
#include "tests/unit/fit_truths.h"

namespace lfd {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kModules = 3;

class FitOfPinholes : public testing::TestWithParam<const char*> {};

TEST_P(FitOfPinholes, RecoversThemThroughNoise) {
  const DisplayCalibration start = *make_display(GetParam(), kModules), truth = perturbed(start, 5);
  const auto simulated = *simulate_observations(truth, few_points());
  const auto fitted = fit_display(start, simulated.observations);
  ASSERT_TRUE(fitted) << fitted.error().message();
  expect_recovered(truth, *fitted);
  EXPECT_THAT(fitted->outliers, IsEmpty());
  for (const ModuleFit& module : fitted->modules) {
    EXPECT_FALSE(module.is_grid);
    EXPECT_NEAR(module.noise_px, kNoise_px, 0.02);
    EXPECT_GT(module.before.median_px, 5 * module.after.median_px);
    EXPECT_LT(module.after.max_px, 6 * kNoise_px);
  }
}

TEST_P(FitOfPinholes, NamesTheOutliersAndNoOther) {
  const DisplayCalibration start = *make_display(GetParam(), kModules), truth = perturbed(start, 6);
  SimulationOptions options = few_points();
  options.outliers = 0.02;
  options.missing = 0.08;
  const auto simulated = *simulate_observations(truth, options);
  ASSERT_GT(simulated.outliers.size(), 5u);
  const auto fitted = fit_display(start, simulated.observations);
  ASSERT_TRUE(fitted) << fitted.error().message();
  expect_recovered(truth, *fitted);
  EXPECT_EQ(lines_of(fitted->outliers), outlier_lines(simulated));
}

INSTANTIATE_TEST_SUITE_P(Displays, FitOfPinholes, testing::Values("desk", "c80-conical"),
                         [](const auto& test) { return std::string(test.param) == "desk" ? "Linear" : "Conical"; });

TEST(Fit, IsExactWithoutNoise) {
  const DisplayCalibration start = *make_display("desk", kModules), truth = perturbed(start, 7);
  SimulationOptions options = few_points();
  options.noise_px = 0;
  options.outliers = 0.01;
  options.missing = 0.05;
  const auto simulated = *simulate_observations(truth, options);
  const auto fitted = fit_display(start, simulated.observations);
  ASSERT_TRUE(fitted) << fitted.error().message();
  EXPECT_LE(map_error(truth, fitted->display).max_px, 1e-6);  // ten times kLeastScale_px, by which priors pull
  EXPECT_EQ(lines_of(fitted->outliers), outlier_lines(simulated));
}

// Truths that no pinhole can represent: the pinhole's picture, displaced by a wave.
DisplayCalibration warped(const DisplayCalibration& display, double amplitude_px) {
  DisplayCalibration result = display;
  const int columns = 41, rows = 31;
  for (ModuleCalibration& module : result.modules) {
    const PinholeMap pinhole = std::get<PinholeMap>(module.map);
    GridNodes nodes;
    nodes.columns = columns;
    nodes.rows = rows;
    nodes.step_u_px = display.image.width / (columns - 1.0);
    nodes.step_v_px = display.image.height / (rows - 1.0);
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const PixelPoint p = nodes.place(column, row);
        const double a = 2 * std::numbers::pi * column / (columns - 1), b = 2 * std::numbers::pi * row / (rows - 1);
        const auto s = screen_from_image(pinhole, {p.x + amplitude_px * std::sin(a + 1) * std::cos(0.7 * b),
                                                   p.y + amplitude_px * std::cos(1.3 * a) * std::sin(b + 0.5)});
        nodes.node.push_back(*s);
      }
    }
    module.map = *GridMap::make(nodes);
  }
  return result;
}

class FitOfGrids : public testing::TestWithParam<bool> {};

TEST_P(FitOfGrids, RecoversWhatNoPinholeCanRepresent) {
  const bool sigmas_are_told = GetParam();
  const DisplayCalibration start = *make_display("desk", kModules), truth = warped(perturbed(start, 8), 2);
  SimulationOptions options = few_points();
  options.points_u = 24;
  options.points_v = 18;
  options.outliers = 0.01;
  options.write_sigma = sigmas_are_told;
  const auto simulated = *simulate_observations(truth, options);
  const auto fitted = fit_display(start, simulated.observations);
  ASSERT_TRUE(fitted) << fitted.error().message();
  expect_grids_recovered(truth, *fitted, simulated.observations);
  EXPECT_EQ(lines_of(fitted->outliers), outlier_lines(simulated));
  for (const ModuleFit& module : fitted->modules) {
    EXPECT_TRUE(module.is_grid);
    EXPECT_GT(module.held_out_pinhole_px.value(), 5 * kNoise_px);
    EXPECT_LT(module.held_out_field_px.value(), 2 * kNoise_px);  // root 2 of it is the noise of both axes
  }
}

INSTANTIATE_TEST_SUITE_P(Sigmas, FitOfGrids, testing::Bool(),
                         [](const auto& test) { return test.param ? "AreTold" : "AreFound"; });

TEST(Fit, GridsAreLeftOutOnRequest) {
  const DisplayCalibration start = *make_display("desk", 2), truth = warped(perturbed(start, 8), 2);
  const auto simulated = *simulate_observations(truth, few_points());
  FitOptions options;
  options.residual_grids = false;
  const auto fitted = fit_display(start, simulated.observations, options);
  ASSERT_TRUE(fitted) << fitted.error().message();
  for (const ModuleCalibration& module : fitted->display.modules) {
    EXPECT_TRUE(std::holds_alternative<PinholeMap>(module.map));
  }
}

// An independent reference: the formulas of pinhole.h at points of the cylinder.
std::optional<PixelPoint> seen_on_cylinder(const PinholeMap& map, double radius_m, ScreenPoint s) {
  const double angle = s.x / radius_m;
  const glm::dvec3 p(radius_m * std::sin(angle), s.y, radius_m * std::cos(angle) - radius_m);
  const glm::dvec3 q = module_from_physical_rotation(map) * (p - to_glm(map.position));
  if (!(q.z > 0)) return std::nullopt;
  const glm::dvec2 a = distort(map, glm::dvec2(q) / q.z);
  return PixelPoint{map.focal_u_px * a.x + map.principal_u_px, map.focal_v_px * a.y + map.principal_v_px};
}

class FitOfCurvedScreens : public testing::TestWithParam<double> {};

TEST_P(FitOfCurvedScreens, RecoversTheRadius) {
  const double radius_m = GetParam();
  DisplayCalibration start = *make_display("desk", 4);
  const DisplayCalibration truth = perturbed(start, 9);
  start.optics.screen_radius_m = 1.1 * radius_m;
  Observations observations{"made", false, {}};
  for (int k = 0; k < 4; ++k) {
    const auto& pinhole = std::get<PinholeMap>(truth.modules[static_cast<std::size_t>(k)].map);
    for (int i = 0; i < 400; ++i) {
      const ScreenPoint s{-0.19 + 0.02 * (i % 20), -0.14 + 0.014 * (i / 20)};
      const auto p = seen_on_cylinder(pinhole, radius_m, s);
      if (!p || !contains(truth.image, *p)) continue;
      observations.points.push_back({k, *p, s, 1, observations.points.size() + 2});
    }
  }
  const auto fitted = fit_display(start, observations);
  ASSERT_TRUE(fitted) << fitted.error().message();
  EXPECT_NEAR(fitted->display.optics.screen_radius_m, radius_m, 1e-4 * std::abs(radius_m));
  EXPECT_LT(fitted->radius_sd_m, 0.01 * std::abs(radius_m));
  for (const ModuleFit& module : fitted->modules) EXPECT_LE(module.after.max_px, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Radii, FitOfCurvedScreens, testing::Values(1.0, -1.5),
                         [](const auto& test) { return test.param > 0 ? "Convex" : "Concave"; });

TEST(Fit, StartsFromHomographies) {
  // The ideal map as a homography: u = (s / width + 1/2) columns, v = (1/2 - y / height) rows.
  DisplayCalibration start = *make_display("desk", kModules);
  const DisplayCalibration truth = perturbed(start, 5);
  const double a = 256 / 0.4, b = 192 / 0.3;
  const HomographyMap ideal{glm::dmat3({a, 0, 0}, {0, -b, 0}, {128, 96, 1})};
  for (ModuleCalibration& module : start.modules) module.map = ideal;
  const auto simulated = *simulate_observations(truth, few_points());
  const auto fitted = fit_display(start, simulated.observations);
  ASSERT_TRUE(fitted) << fitted.error().message();
  expect_recovered(truth, *fitted);

  start.modules[1].map = HomographyMap{glm::dmat3({a, 0, 0}, {0, b, 0}, {128, 96, 1})};
  const auto mirrored = fit_display(start, simulated.observations);
  ASSERT_FALSE(mirrored);
  EXPECT_THAT(mirrored.error().message(), HasSubstr("start: module 1: homography: "));
}

TEST(Fit, DoesNotDependOnTheOrderOfLines) {
  const DisplayCalibration start = *make_display("desk", 2), truth = perturbed(start, 10);
  SimulationOptions options = few_points();
  options.outliers = 0.01;
  auto simulated = *simulate_observations(truth, options);
  const auto one = fit_display(start, simulated.observations);
  std::shuffle(simulated.observations.points.begin(), simulated.observations.points.end(), std::mt19937(3));
  const auto other = fit_display(start, simulated.observations);
  ASSERT_TRUE(one && other);
  EXPECT_EQ(one->display, other->display);
  EXPECT_EQ(one->outliers, other->outliers);
}

}  // namespace
}  // namespace lfd
