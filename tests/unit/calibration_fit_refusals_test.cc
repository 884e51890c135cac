// Fits that are refused: what cannot be determined, and what cannot be true, each with its reason and place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibration/fit/fit.h"
#include "calibration/fit/simulate.h"
#include "calibration/make.h"

namespace lfd {
namespace {

using testing::HasSubstr;

// Fits what `spoil` leaves of good observations; the message of the refusal.
template <class Spoil>
std::string refusal(Spoil spoil) {
  const DisplayCalibration start = *make_display("desk", 2);
  auto observations =
      simulate_observations(perturbed(start, 11), {.outliers = 0, .missing = 0, .points_u = 20, .points_v = 15})
          ->observations;
  observations.source = "seen.csv";
  spoil(observations.points);
  const auto fitted = fit_display(start, observations);
  return fitted ? "" : fitted.error().message();
}

// Keeps those points of module 1 that `keep` wants, and all of module 0.
template <class Keep>
auto only(Keep keep) {
  return [keep](std::vector<Observation>& points) {
    std::erase_if(points, [&](const Observation& o) { return o.module == 1 && !keep(o); });
  };
}

TEST(FitRefusals, WhatCannotBeDetermined) {
  EXPECT_THAT(refusal([](auto& points) { points.clear(); }), HasSubstr("seen.csv: module 0: no observations"));
  EXPECT_THAT(refusal(only([](const Observation&) { return false; })),
              HasSubstr("seen.csv: module 1: no observations"));
  int left = 7;
  EXPECT_THAT(refusal(only([&left](const Observation&) { return left-- > 0; })),
              HasSubstr("seen.csv: module 1: 7 observations are 14 numbers; a pinhole has 15 parameters"));
  EXPECT_THAT(refusal(only([](const Observation& o) { return std::abs(o.in_image.y - 96) < 1; })),
              HasSubstr("seen.csv: module 1: all observations lie on a line of the image"));
  const std::string clump =
      refusal(only([](const Observation& o) { return std::hypot(o.in_image.x - 128, o.in_image.y - 96) < 25; }));
  EXPECT_THAT(clump, HasSubstr("seen.csv: module 1: under-determined: "));
  EXPECT_THAT(clump, HasSubstr("undetermined: "));
}

// Ideal maps fill the screen whatever its radius: as pinholes they belong to a plane.
TEST(FitRefusals, ARadiusFarFromTheStarts) {
  for (const double radius : {2.0, -1.0}) {
    const DisplayCalibration start = *curved(*make_display("desk", 2), radius, false);
    auto observations =
        simulate_observations(start, {.outliers = 0, .missing = 0, .points_u = 20, .points_v = 15})->observations;
    observations.source = "seen.csv";
    const auto fitted = fit_display(start, observations);
    ASSERT_FALSE(fitted) << fitted->display.optics.screen_radius_m;
    EXPECT_THAT(fitted.error().message(), HasSubstr("seen.csv: a screen radius of "));
  }
}

TEST(FitRefusals, WhatCannotBeTrue) {
  EXPECT_THAT(refusal([](auto& points) { points[4].in_image.x = 256.5; }), HasSubstr("seen.csv:6: u, v: (256.5, "));
  EXPECT_THAT(refusal([](auto& points) { points[4].module = 2; }),
              HasSubstr("seen.csv:6: module: 2; the display has modules 0 to 1"));
  EXPECT_THAT(refusal([](auto& points) {
                points[9].in_image = points[4].in_image;
                points[9].on_screen = points[4].on_screen;
              }),
              HasSubstr("seen.csv:11: repeats the observation of line 6"));
  EXPECT_THAT(refusal([](auto& points) {
                for (Observation& o : points) o.on_screen.y = 0.1 * o.on_screen.x;
              }),
              HasSubstr("seen.csv: module 0: all observations lie on a line of the screen"));
}

TEST(FitRefusals, OptionsOutOfRange) {
  const DisplayCalibration start = *make_display("desk", 2);
  const auto observations = simulate_observations(start, {})->observations;
  for (const double sd : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    FitOptions options;
    options.emitter_sd_m = sd;
    const auto fitted = fit_display(start, observations, options);
    ASSERT_FALSE(fitted);
    EXPECT_THAT(fitted.error().message(), HasSubstr("standard deviation of the emitters"));
  }
}

}  // namespace
}  // namespace lfd
