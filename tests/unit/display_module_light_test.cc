// Colour calibrations as a viewer sees them: what modules are fed for one light looks like that light.
#include "display/module_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/srgb.h"
#include "calibration/make.h"
#include "calibration/make_color.h"
#include "display/viewer.h"
#include "proto/pictures/srgb.h"

namespace lfd::display {
namespace {

DisplayCalibration small_desk() {
  DisplayCalibration display = *make_display("desk");
  display.image = {32, 24};
  return display;
}

// What the module is fed to show one light everywhere.
Picture8 fed_for(const DisplayCalibration& display, const ModuleCalibration& module, glm::dvec3 light) {
  Picture8 picture = black_picture(display.image.width, display.image.height);
  for (int row = 0; row < display.image.height; ++row) {
    for (int column = 0; column < display.image.width; ++column) {
      const glm::dvec3 gain = gain_at(module.color->gain, display.image, centre_of({column, row}));
      const glm::dvec3 drive = drive_for(*module.color, gain, light);
      for (int c = 0; c < 3; ++c) {
        picture.rgba[4 * (static_cast<std::size_t>(row) * display.image.width + column) + c] =
            static_cast<std::uint8_t>(std::lround(255 * drive[c]));
      }
    }
  }
  return picture;
}

Picture8 seen(const DisplayCalibration& display, const std::vector<Picture8>& images) {
  std::vector<const Picture8*> pointers;
  for (const auto& image : images) pointers.push_back(&image);
  const auto picture = viewer_picture(display, pointers, {0.05, 0.02, 0.8}, 60, 45);
  LFD_CHECK(picture, picture.error().message());
  return *picture;
}

std::vector<Picture8> all_fed_for(const DisplayCalibration& display, glm::dvec3 light) {
  std::vector<Picture8> images;
  for (const auto& module : display.modules) images.push_back(fed_for(display, module, light));
  return images;
}

TEST(ModuleLight, WithoutColourBytesAreSrgb) {
  const DisplayCalibration display = small_desk();
  const ModuleLight light(display.modules[0], display.image);
  const std::uint8_t texel[3] = {0, 100, 255};
  const glm::dvec3 emitted = light.emitted(texel);
  EXPECT_EQ(emitted, glm::dvec3(0, linear_from_srgb(100 / 255.0), 1));
  EXPECT_EQ(light.gain({5, 6}), glm::dvec3(1));
}

// Half a byte of drive at gamma 2.4 is 2.4 / 510 of the light; the inverse of the matrix makes at most 1.19 times that
// of it, a gain of 0.8 in the denominator 1.25 times: 0.0071. Half a byte of the picture is 0.0045 of the light at
// most.
constexpr double kQuantisation = 0.0071 + 0.0045;

TEST(ModuleLight, DifferentModulesLookAlike) {
  const DisplayCalibration display = colored(small_desk(), 5);
  for (const glm::dvec3& light : {glm::dvec3(1), glm::dvec3(0), glm::dvec3(0.5, 0.2, 0.05), glm::dvec3(0, 0, 1)}) {
    const Picture8 picture = seen(display, all_fed_for(display, light));
    for (std::size_t at = 0; at < picture.rgba.size(); ++at) {
      if (at % 4 == 3) continue;
      ASSERT_NEAR(linear_from_srgb(picture.rgba[at] / 255.0), light[static_cast<int>(at % 4)], kQuantisation);
    }
  }
}

// A ramp: the left of each image is left to the neighbours, and so is all of module 3.
TEST(ModuleLight, BlendsByGainsDownToNone) {
  DisplayCalibration display = small_desk();
  for (auto& module : display.modules) {
    module.color.emplace();
    module.color->gain = {2, 1, {glm::dvec3(0), glm::dvec3(1)}};
  }
  display.modules[3].color->gain = {1, 1, {glm::dvec3(0)}};
  const glm::dvec3 light(0.5);
  const Picture8 picture = seen(display, all_fed_for(display, light));
  for (int row = 0; row < picture.height; ++row) {
    // Where less than an eighth is left of the light, the bytes have too few steps.
    for (int column = picture.width / 8; column < picture.width; ++column) {
      const std::size_t at = 4 * (static_cast<std::size_t>(row) * picture.width + column);
      // Half a byte of sRGB is 0.0045 of the light at most; an eighth of gain makes 8 times less light, where half a
      // byte is 0.0013, and 0.0104 of the whole.
      ASSERT_NEAR(linear_from_srgb(picture.rgba[at] / 255.0), 0.5, 0.0045 + 0.0104) << column << ' ' << row;
    }
  }
}

TEST(ModuleLight, ABlackLevelIsSeen) {
  DisplayCalibration display = small_desk();
  for (auto& module : display.modules) {
    module.color.emplace();
    module.color->black_level = {0.02, 0.05, 0.1};
  }
  const Picture8 black = seen(display, all_fed_for(display, glm::dvec3(0)));
  EXPECT_EQ(black.rgba[0], srgb8_from_linear(0.02));
  EXPECT_EQ(black.rgba[1], srgb8_from_linear(0.05));
  EXPECT_EQ(black.rgba[2], srgb8_from_linear(0.1));
  const Picture8 grey = seen(display, all_fed_for(display, glm::dvec3(0.3)));
  // Rounded twice.
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(grey.rgba[static_cast<std::size_t>(c)], srgb8_from_linear(0.3), 1);
}

}  // namespace
}  // namespace lfd::display
