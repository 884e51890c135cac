// Observations: CSV in and out, every refusal with its place; and simulated ones, which are what was asked for.
#include "calibration/fit/observations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibration/fit/simulate.h"
#include "calibration/make.h"

namespace lfd {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(Observations, ReadsColumnsInAnyOrder) {
  const auto read =
      parse_observations("\xEF\xBB\xBFy, s ,module,sigma,v,u\r\n0.5,-1e-1,3,0.25,+7,8.5\r\n\r\n", "a.csv");
  ASSERT_TRUE(read) << read.error().message();
  ASSERT_EQ(read->points.size(), 1u);
  EXPECT_TRUE(read->has_sigma);
  EXPECT_EQ(read->points[0], (Observation{3, {8.5, 7}, {-0.1, 0.5}, 0.25, 2}));
  EXPECT_EQ(read->place_of(read->points[0]), "a.csv:2");
}

TEST(Observations, SigmaMayBeUnknown) {
  const auto read = parse_observations("module,u,v,s,y\n0,1,2,3,4", "a.csv");
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_FALSE(read->has_sigma);
  EXPECT_EQ(read->points.size(), 1u);
}

TEST(Observations, WrittenOnesReadBackEqual) {
  for (const bool has_sigma : {false, true}) {
    Observations written{"x.csv", has_sigma, {}};
    written.points.push_back({0, {0.1, 1.0 / 3}, {-1e-9, std::nextafter(0.2, 1)}, has_sigma ? 0.07 : 1, 2});
    written.points.push_back({1023, {1e5, 0}, {9e3, -9e3}, has_sigma ? 1e-6 : 1, 3});
    const auto read = parse_observations(print_observations(written), "x.csv");
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(*read, written);
  }
}

std::string refusal(std::string_view text) {
  const auto read = parse_observations(text, "a.csv");
  return read ? "" : read.error().message();
}

TEST(Observations, RefusesHeadersByName) {
  EXPECT_THAT(refusal(""), StartsWith("a.csv: is empty"));
  EXPECT_THAT(refusal("\n \n"), StartsWith("a.csv: is empty"));
  EXPECT_EQ(refusal("module,u,v,s\n"), "a.csv:1: column \"y\": is missing");
  EXPECT_THAT(refusal("module,u,v,s,y,colour\n"), StartsWith("a.csv:1: column \"colour\": unknown"));
  EXPECT_THAT(refusal("\nmodule,u,v,s,y,u\n"), StartsWith("a.csv:2: column \"u\": is there twice"));
  EXPECT_THAT(refusal("0,1,2,3,4\n"), StartsWith("a.csv:1: column \"0\": unknown"));
}

TEST(Observations, RefusesNumbersByLineAndField) {
  const auto line = [](const std::string& fields) { return refusal("module,u,v,s,y,sigma\n0,1,2,3,4,1\n" + fields); };
  EXPECT_EQ(line("0,1,2,3,4,1\n"), "");
  EXPECT_EQ(line("0,one,2,3,4,1\n"), "a.csv:3: u: \"one\": is not a number");
  EXPECT_EQ(line("0,1,2x,3,4,1\n"), "a.csv:3: v: \"2x\": is not a number");
  EXPECT_EQ(line("0,1,,3,4,1\n"), "a.csv:3: v: \"\": is not a number");
  EXPECT_EQ(line("0,1,2,nan,4,1\n"), "a.csv:3: s: \"nan\": must be finite");
  EXPECT_EQ(line("0,1,2,3,-inf,1\n"), "a.csv:3: y: \"-inf\": must be finite");
  EXPECT_EQ(line("0,1,2,3,1e999,1\n"), "a.csv:3: y: \"1e999\": is out of range");
  EXPECT_THAT(line("0,1,2,3,1e5,1\n"), StartsWith("a.csv:3: y: 100000: must be within"));
  EXPECT_THAT(line("0,1e7,2,3,4,1\n"), StartsWith("a.csv:3: u: "));
  EXPECT_THAT(line("1.5,1,2,3,4,1\n"), HasSubstr("module: 1.5: a whole number"));
  EXPECT_THAT(line("-1,1,2,3,4,1\n"), HasSubstr("module: -1: must be within 0 and 1023"));
  EXPECT_THAT(line("0,1,2,3,4,0\n"), StartsWith("a.csv:3: sigma: 0: must be within"));
  EXPECT_THAT(line("0,1,2,3,4\n"), StartsWith("a.csv:3: sigma: is missing"));
  EXPECT_THAT(line("0,1,2,3,4,1,9\n"), StartsWith("a.csv:3: more fields than the header's 6"));
  EXPECT_THAT(line(std::string(1000, 'x')), testing::SizeIs(testing::Lt(120u)));
}

TEST(Simulation, WithoutSpoilingIsTheMapItself) {
  const DisplayCalibration display = perturbed(*make_display("desk", 2), 3);
  const auto made = simulate_observations(display, {.noise_px = 0, .outliers = 0, .missing = 0});
  ASSERT_TRUE(made);
  EXPECT_TRUE(made->outliers.empty());
  for (const Observation& o : made->observations.points) {
    const auto s = screen_from_image(display, display.modules[static_cast<std::size_t>(o.module)], o.in_image);
    ASSERT_TRUE(s);
    EXPECT_EQ(*s, o.on_screen);
  }
}

TEST(Simulation, SpoilsAsMuchAsAsked) {
  const DisplayCalibration display = *make_display("desk", 4);
  const SimulationOptions options{.noise_px = 0.5, .outliers = 0.02, .missing = 0.1, .points_u = 60, .points_v = 45};
  const auto made = simulate_observations(display, options);
  ASSERT_TRUE(made);
  const auto& points = made->observations.points;
  // An area of 4.5 of the 45 rows takes 4 or 5 of them: 1.1 % of all points.
  EXPECT_NEAR(static_cast<double>(points.size()), 0.9 * 4 * 60 * 45, 0.02 * 4 * 60 * 45);
  // Shares are within five standard deviations.
  EXPECT_NEAR(static_cast<double>(made->outliers.size()), 0.02 * static_cast<double>(points.size()),
              5 * std::sqrt(0.02 * static_cast<double>(points.size())));
  double squares = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_TRUE(contains(display.image, points[i].in_image));
    const auto p = image_from_screen(display, display.modules[0], points[i].on_screen);  // all maps are ideal
    const double du = points[i].in_image.x - p->x, dv = points[i].in_image.y - p->y;
    if (std::ranges::binary_search(made->outliers, i)) {
      EXPECT_GT(std::hypot(du, dv), 10 - 6 * 0.5);
    } else {
      EXPECT_LT(std::max(std::abs(du), std::abs(dv)), 6 * 0.5);
      squares += du * du + dv * dv;
    }
  }
  EXPECT_NEAR(std::sqrt(squares / (2.0 * static_cast<double>(points.size()))), 0.5, 0.02);
}

TEST(Simulation, SeesNothingWhereAllIsMissing) {
  const auto made = simulate_observations(*make_display("desk", 4), {.outliers = 0, .missing = 1});
  ASSERT_TRUE(made);
  EXPECT_EQ(made->observations.points.size(), 0u);
}

TEST(Simulation, LineNumbersAreThoseOfTheFile) {
  const DisplayCalibration display = *make_display("desk", 2);
  const auto made = simulate_observations(display, {.write_sigma = true, .seed = 4});
  ASSERT_TRUE(made);
  const auto read = parse_observations(print_observations(made->observations), "");
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, made->observations);
  EXPECT_EQ(simulate_observations(display, {.write_sigma = true, .seed = 4})->observations, made->observations);
  EXPECT_NE(simulate_observations(display, {.write_sigma = true, .seed = 5})->observations, made->observations);
}

TEST(Simulation, RefusesOptionsOutOfRange) {
  const DisplayCalibration display = *make_display("desk", 2);
  const auto refused = [&](const SimulationOptions& options) {
    const auto made = simulate_observations(display, options);
    return made ? "" : made.error().message();
  };
  EXPECT_THAT(refused({.noise_px = -1}), StartsWith("noise: "));
  EXPECT_THAT(refused({.noise_px = std::numeric_limits<double>::quiet_NaN()}), StartsWith("noise: "));
  EXPECT_THAT(refused({.outliers = 1.5}), StartsWith("outliers: "));
  EXPECT_THAT(refused({.missing = -0.1}), StartsWith("missing: "));
  EXPECT_THAT(refused({.points_u = 1}), StartsWith("points: "));
  EXPECT_THAT(refused({.points_u = 4000, .points_v = 4000}), StartsWith("points: 32000000 in all"));
  EXPECT_THAT(refused({.noise_px = 0, .write_sigma = true}), StartsWith("noise: "));
}

}  // namespace
}  // namespace lfd
