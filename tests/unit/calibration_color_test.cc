// Colour calibrations: known answers of the equations, their inverse, bad input by name, and files.
#include "calibration/color.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <random>

#include "base/file.h"
#include "base/srgb.h"
#include "calibration/make.h"
#include "calibration/make_color.h"
#include "proto/calibration_file.h"

namespace lfd {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kRounding = 1e-12;  // a few dozen operations in double on numbers of about 1
const glm::dvec3 kFull(1);

void expect_near(glm::dvec3 found, glm::dvec3 expected, double tolerance = kRounding) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], tolerance) << "channel " << c;
}

ColorCalibration linear_color() {
  ColorCalibration color;
  color.curve.fill(GammaCurve{1});
  return color;
}

TEST(Color, WithoutNumbersIsSrgb) {
  const ColorCalibration color;
  for (const double light : {0.0, 0.001, 0.2, 1.0})
    expect_near(drive_for(color, kFull, glm::dvec3(light)), glm::dvec3(srgb_from_linear(light)));
}

TEST(Color, KnownAnswers) {
  const glm::dvec3 light(0.5, 0.25, 0.1);
  expect_near(drive_for(linear_color(), glm::dvec3(0.5), light), {0.25, 0.125, 0.05});

  ColorCalibration swapped = linear_color();
  swapped.device_from_display = glm::dmat3({0, 0, 1}, {0, 1, 0}, {1, 0, 0});
  expect_near(drive_for(swapped, kFull, light), {0.1, 0.25, 0.5});
  expect_near(emitted_by(swapped, {0.1, 0.25, 0.5}), light);

  ColorCalibration gamma;
  gamma.curve.fill(GammaCurve{2.2});
  expect_near(drive_for(gamma, kFull, light),
              {std::pow(0.5, 1 / 2.2), std::pow(0.25, 1 / 2.2), std::pow(0.1, 1 / 2.2)});

  ColorCalibration black = linear_color();
  black.black_level = {0.1, 0.2, 0.3};
  expect_near(drive_for(black, kFull, light), {0.4, 0.05, 0});
  expect_near(emitted_by(black, {0, 0, 0}), {0.1, 0.2, 0.3});
  expect_near(emitted_by(black, {0.4, 0.05, 0}), {0.5, 0.25, 0.3});  // darker than the black level is not possible

  // Light beyond full is full before the gain takes its share.
  expect_near(drive_for(linear_color(), glm::dvec3(0.5), glm::dvec3(7)), glm::dvec3(0.5));
}

TEST(Color, ATablesSamplesAreMetAndWhatLiesBetweenIsLinear) {
  const TransferCurve table = TableCurve{{0.1, 0.3, 0.3, 0.9}};
  EXPECT_NEAR(drive_from_light(table, 0), 0.1, kRounding);
  EXPECT_NEAR(drive_from_light(table, 1 / 6.0), 0.2, kRounding);
  EXPECT_NEAR(drive_from_light(table, 0.5), 0.3, kRounding);
  EXPECT_NEAR(drive_from_light(table, 1), 0.9, kRounding);
  EXPECT_NEAR(light_from_drive(table, 0.2), 1 / 6.0, kRounding);
  EXPECT_NEAR(light_from_drive(table, 0.3), 1 / 3.0, kRounding) << "the least light that has the drive";
  EXPECT_NEAR(light_from_drive(table, 0.6), 5 / 6.0, kRounding);
  EXPECT_EQ(light_from_drive(table, 0.05), 0);
  EXPECT_EQ(light_from_drive(table, 0.1), 0);
  EXPECT_EQ(light_from_drive(table, 0.95), 1);
}

TEST(Color, GainsAreBilinearBetweenNodesOnTheBorder) {
  const GainMap map{2, 2, {{0, 1, 2}, {1, 1, 2}, {0, 1, 4}, {1, 1, 4}}};
  const ImageSize image{200, 100};
  expect_near(gain_at(map, image, {0, 0}), {0, 1, 2});
  expect_near(gain_at(map, image, {200, 100}), {1, 1, 4});
  expect_near(gain_at(map, image, {50, 75}), {0.25, 1, 3.5});
  const GainMap row{3, 1, {{0, 0, 0}, {1, 1, 1}, {0, 0, 0}}};
  for (const double v : {0.0, 31.0, 100.0}) expect_near(gain_at(row, image, {150, v}), {0.5, 0.5, 0.5});
  expect_near(gain_at(GainMap{}, image, {3, 4}), kFull);
}

// Whatever the numbers: what is emitted is the gain's share of the light, wherever the device can make it.
TEST(Color, WhatIsEmittedIsTheLightThatIsMeant) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 2000; ++i) {
    ColorCalibration color;
    for (int c = 0; c < 3; ++c) {
      color.black_level[c] = 0.05 * unit(random);
      for (int r = 0; r < 3; ++r) color.device_from_display[c][r] = (c == r ? 0.9 : 0) + 0.1 * (unit(random) - 0.5);
    }
    color.curve[1] = GammaCurve{1.5 + unit(random)};
    color.curve[2] = TableCurve{{0.05, 0.2 + 0.2 * unit(random), 0.5, 1}};
    ASSERT_TRUE(validate(color));
    const glm::dvec3 gain(0.6 + 0.4 * unit(random)), light(0.35 + 0.4 * unit(random));
    expect_near(emitted_by(color, drive_for(color, gain, light)), gain * light);
  }
}

TEST(Color, BadNumbersAreRefusedByName) {
  const auto error_of = [](auto change) {
    ColorCalibration color = linear_color();
    change(color);
    const Status status = validate(color);
    return status ? std::string("accepted") : status.error().message();
  };
  using C = ColorCalibration;
  EXPECT_EQ(error_of([](C&) {}), "accepted");
  EXPECT_THAT(error_of([](C& c) { c.gain.columns = 0; }), StartsWith("gain: columns: 0"));
  EXPECT_THAT(error_of([](C& c) { c.gain.rows = 129; }), StartsWith("gain: rows: 129"));
  EXPECT_THAT(error_of([](C& c) { c.gain.rows = 2; }), StartsWith("gain: r: 1 numbers; 1 columns x 2 rows are 2"));
  EXPECT_THAT(error_of([](C& c) { c.gain.node[0].g = -0.1; }), StartsWith("gain: g 0: -0.1"));
  EXPECT_THAT(error_of([](C& c) { c.gain.node[0].b = kNan; }), StartsWith("gain: b 0: nan"));
  EXPECT_THAT(error_of([](C& c) { c.gain.node[0].r = 1e30; }), StartsWith("gain: r 0: 1e+30"));
  EXPECT_THAT(error_of([](C& c) { c.black_level[2] = 1; }), StartsWith("black_level 2: 1"));
  EXPECT_THAT(error_of([](C& c) { c.black_level[0] = kNan; }), StartsWith("black_level 0: nan"));
  EXPECT_THAT(error_of([](C& c) { c.device_from_display[1][2] = kNan; }), StartsWith("device_from_display 7: nan"));
  EXPECT_EQ(error_of([](C& c) { c.device_from_display[0] = c.device_from_display[1]; }),
            "device_from_display: is singular");
  EXPECT_EQ(error_of([](C& c) { c.device_from_display = glm::dmat3(0); }), "device_from_display: is singular");
  EXPECT_THAT(error_of([](C& c) { c.device_from_display[0] = 1e-7 * c.device_from_display[0]; }),
              StartsWith("device_from_display: is singular or nearly so: condition number "));
  EXPECT_THAT(error_of([](C& c) { c.curve[0] = GammaCurve{0}; }), StartsWith("red: gamma: 0"));
  EXPECT_THAT(error_of([](C& c) { c.curve[1] = GammaCurve{kNan}; }), StartsWith("green: gamma: nan"));
  EXPECT_THAT(error_of([](C& c) { c.curve[2] = TableCurve{{0.5}}; }), StartsWith("blue: drive: 1 samples"));
  EXPECT_THAT(error_of([](C& c) { c.curve[2] = TableCurve{std::vector<double>(4097)}; }),
              StartsWith("blue: drive: 4097 samples"));
  EXPECT_THAT(error_of([](C& c) { c.curve[0] = TableCurve{{0, 0.5, 0.4, 1}}; }), StartsWith("red: drive 2: 0.4 falls"));
  EXPECT_THAT(error_of([](C& c) { c.curve[0] = TableCurve{{0, kNan}}; }), StartsWith("red: drive 1: nan"));
  EXPECT_THAT(error_of([](C& c) { c.curve[0] = TableCurve{{0.3, 0.3}}; }), StartsWith("red: drive: all samples"));
}

TEST(ColorOfDisplays, MadeOnesAreValidAndCanShowEveryColour) {
  const DisplayCalibration plain = perturbed(*make_display("desk"), 4), display = colored(plain, 7);
  ASSERT_TRUE(validate(display)) << validate(display).error().message();
  EXPECT_EQ(display, colored(plain, 7));
  EXPECT_FALSE(display == colored(plain, 8));
  double least = 1;
  for (std::size_t k = 0; k < display.modules.size(); ++k) {
    EXPECT_EQ(display.modules[k].map, plain.modules[k].map);
    const ColorCalibration& color = *display.modules[k].color;
    for (const glm::dvec3& node : color.gain.node) {
      for (int c = 0; c < 3; ++c) {
        EXPECT_GE(node[c], 0.8);
        EXPECT_LE(node[c], 1);
        least = std::min(least, node[c]);
      }
    }
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 light(corner & 1, corner >> 1 & 1, corner >> 2);
      const glm::dvec3 gain = gain_at(color.gain, display.image, {10.0 * corner, 20});
      expect_near(emitted_by(color, drive_for(color, gain, light)), gain * light);
    }
  }
  EXPECT_LT(least, 0.9);
}

TEST(ColorOfDisplays, StaysWhenAnInstallationIsPerturbed) {
  const DisplayCalibration display = colored(*make_display("desk"), 7);
  EXPECT_EQ(perturbed(display, 1).modules[2].color, display.modules[2].color);
}

class ColorFile : public testing::Test {
 protected:
  ColorFile()
      : file_(std::filesystem::path(testing::TempDir()) /
              ("color-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".textproto")) {}
  ~ColorFile() override { std::filesystem::remove(file_); }

  // Of a display of one module with this colour message from line 6 on; "read" where there is none.
  std::string error_of(const std::string& color) const {
    const std::string text =
        "screen { width_m: 0.4 height_m: 0.3 }\nimage { width_px: 64 height_px: 48 }\n"
        "optics { diffuser: LINEAR observer_distance_m: 1 }\nangular_scattering_rad: 0.1\n"
        "module { emitter { z: -1 } ideal {}\n" +
        color + "}\n";
    EXPECT_TRUE(write_file(file_, text));
    const auto display = load_calibration(file_);
    return display ? "read" : display.error().message();
  }

  std::filesystem::path file_;
};

TEST_F(ColorFile, LoadsWhatWasSaved) {
  DisplayCalibration display = colored(*make_display("desk"), 3);
  display.modules[1].color.reset();
  display.modules[2].color->curve = {TransferCurve{SrgbCurve{}}, GammaCurve{1.8}, TableCurve{{0, 0.3, 0.3, 1}}};
  display.modules[2].color->black_level = {0.01, 0, 0.02};
  ASSERT_TRUE(save_calibration(file_, display));
  const auto loaded = load_calibration(file_);
  ASSERT_TRUE(loaded) << loaded.error().message();
  EXPECT_EQ(*loaded, display);
  EXPECT_EQ(calibration_hash(*loaded), calibration_hash(display));
  display.modules[2].color->black_level.x = 0.011;
  EXPECT_NE(calibration_hash(*loaded), calibration_hash(display)) << "colour counts";
}

TEST_F(ColorFile, WithoutColourNothingOfItIsWritten) {
  const auto message = write_calibration(*make_display("desk"));
  for (const auto& module : message.module()) EXPECT_FALSE(module.has_color());
}

TEST_F(ColorFile, EveryBadFieldIsNamedWithItsLine) {
  const auto place = [](int line, const std::string& rest) {
    return HasSubstr(".textproto:" + std::to_string(line) + ": module 0: color: " + rest);
  };
  EXPECT_EQ(error_of("color {}"), "read");
  EXPECT_EQ(error_of("color { red { gamma: 2.2 } blue { drive: [0, 0.5, 1] } }"), "read");
  EXPECT_THAT(error_of("color {\n gain { columns: 1 rows: 1\n r: 1\n g: -2\n b: 1 } }"), place(9, "gain: g 0: -2"));
  EXPECT_THAT(error_of("color {\n gain { columns: 1 rows: 1 r: 1 g: 1 } }"),
              place(7, "gain: 1 numbers r, 1 numbers g"));
  EXPECT_THAT(error_of("color {\n gain { columns: 2 rows: 1 r: 1 g: 1 b: 1 } }"), place(7, "gain: r: 1 numbers; 2"));
  EXPECT_THAT(error_of("color {\n gain {} }"), place(7, "gain: columns: 0"));
  EXPECT_THAT(error_of("color {\n black_level: [0, 0] }"), place(7, "black_level: 2 numbers"));
  EXPECT_THAT(error_of("color {\n black_level: [0, nan, 0] }"), place(7, "black_level 1: nan"));
  EXPECT_THAT(error_of("color {\n device_from_display: [1, 2] }"), place(7, "device_from_display: 2 numbers"));
  EXPECT_THAT(error_of("color {\n device_from_display: [1, 0, 0, 0, 1, 0, 0, 1, 0] }"),
              place(7, "device_from_display: is singular"));
  EXPECT_THAT(error_of("color { green {\n gamma: 0 } }"), place(7, "green: gamma: 0"));
  EXPECT_THAT(error_of("color { green {\n gamma: 2\n drive: [0, 1] } }"), place(6, "green: gamma and drive"));
  EXPECT_THAT(error_of("color {\n blue {} }"), place(7, "blue: one of gamma, drive"));
  EXPECT_THAT(error_of("color { red {\n drive: 0\n drive: 0.4\n drive: 0.3 } }"), place(9, "red: drive 2: 0.3 falls"));
}

}  // namespace
}  // namespace lfd
