// What a viewer sees: against the formulas written once more, constants, a picture on the screen, and points at depth.
#include "display/viewer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "display/contact_sheet.h"
#include "proto/pictures/srgb.h"

namespace lfd::display {
namespace {

using testing::HasSubstr;

constexpr double kDegree = 3.14159265358979323846 / 180;

// A display in the manner of design geometry, section 6: `count` emitters at equal pitch over `fov`.
DisplayCalibration made_display(int count, ImageSize image, Diffuser diffuser = Diffuser::kLinear,
                                double emitter_height = 0) {
  DisplayCalibration display{"test", {0.4, 0.3}, image, {diffuser, 0, 0.8}, 0, {}};
  const double distance = 0.6, half = distance * std::tan(20 * kDegree);
  for (int m = 0; m < count; ++m) {
    const double x = count == 1 ? 0 : half * (2.0 * m / (count - 1) - 1);
    display.modules.push_back({{x, emitter_height, -distance}, IdealMap{}});
  }
  display.angular_scattering_rad = 1.5 * 40 * kDegree / std::max(1, count - 1);
  return display;
}

std::vector<const Picture8*> all(const std::vector<Picture8>& pictures) {
  std::vector<const Picture8*> pointers;
  for (const auto& picture : pictures) pointers.push_back(&picture);
  return pointers;
}

Picture8 noise(ImageSize size, unsigned seed) {
  std::mt19937 random(seed);
  Picture8 picture = black_picture(size.width, size.height);
  for (std::size_t at = 0; at < picture.rgba.size(); ++at)
    picture.rgba[at] = at % 4 == 3 ? 255 : std::uint8_t(random());
  return picture;
}

Picture8 seen(const DisplayCalibration& display, const std::vector<Picture8>& images, const Eye& eye, int width,
              int height) {
  const auto picture = viewer_picture(display, all(images), eye, width, height);
  EXPECT_TRUE(picture) << (picture ? "" : picture.error().message());
  return *picture;
}

double weight_by_the_book(const DisplayCalibration& display, const Emitter& e, double sx, double sy, const Eye& eye) {
  const double sigma = display.angular_scattering_rad / 1.11741;
  if (display.optics.diffuser == Diffuser::kLinear) {
    const double theta_in = std::atan((sx - e.x) / -e.z), theta_out = std::atan((eye.x - sx) / eye.z);
    return std::exp(-(theta_in - theta_out) * (theta_in - theta_out) / (sigma * sigma));
  }
  const double rho_in = (sx - e.x) / std::sqrt((sy - e.y) * (sy - e.y) + e.z * e.z);
  const double rho_out = (eye.x - sx) / std::sqrt((eye.y - sy) * (eye.y - sy) + eye.z * eye.z);
  return std::exp(-(rho_in - rho_out) * (rho_in - rho_out) / (sigma * sigma));
}

class ViewerOf : public testing::TestWithParam<Diffuser> {};
INSTANTIATE_TEST_SUITE_P(DisplayViewer, ViewerOf, testing::Values(Diffuser::kLinear, Diffuser::kConical));

// The output grid is the images' own, so that each sample is one texel.
TEST_P(ViewerOf, BlendsByTheFormulasOfTheBook) {
  const DisplayCalibration display = made_display(9, {16, 12}, GetParam(), -0.2);
  std::vector<Picture8> images;
  for (unsigned m = 0; m < 9; ++m) images.push_back(noise(display.image, m));
  const Eye eye{0.07, 0.1, 0.75};
  const Picture8 picture = seen(display, images, eye, 16, 12);
  for (int row = 0; row < 12; ++row) {
    for (int column = 0; column < 16; ++column) {
      const double sx = ((column + 0.5) / 16 - 0.5) * 0.4, sy = (0.5 - (row + 0.5) / 12) * 0.3;
      for (int channel = 0; channel < 3; ++channel) {
        const std::size_t at = 4 * (16 * row + column) + channel;
        double sum = 0, weights = 0;
        for (int m = 0; m < 9; ++m) {
          const double weight = weight_by_the_book(display, display.modules[m].emitter, sx, sy, eye);
          sum += weight * linear_from_srgb(images[m].rgba[at] / 255.0);
          weights += weight;
        }
        // 0.51: rounding to 8 bits.
        ASSERT_NEAR(picture.rgba[at], 255 * srgb_from_linear(sum / weights), 0.51) << column << ' ' << row;
      }
    }
  }
}

TEST_P(ViewerOf, SeesAConstantWhereverTheEyeIs) {
  const DisplayCalibration display = made_display(8, {8, 6}, GetParam(), -0.1);
  Picture8 gray = black_picture(8, 6);
  for (std::size_t at = 0; at < gray.rgba.size(); ++at) gray.rgba[at] = at % 4 == 3 ? 255 : 137;
  const std::vector<Picture8> images(8, gray);
  // Far to the side and close by, all weights underflow: the nearest module's light must remain.
  for (const Eye eye : {Eye{0, 0, 0.8}, Eye{0.3, 0.2, 1.5}, Eye{1e4, 0, 0.01}, Eye{-50, 1000, 1e-9}}) {
    const Picture8 picture = seen(display, images, eye, 30, 20);
    for (std::size_t at = 0; at < picture.rgba.size(); ++at) ASSERT_EQ(picture.rgba[at], at % 4 == 3 ? 255 : 137);
  }
}

TEST_P(ViewerOf, SeesAPictureOnTheScreenAsItIs) {
  const DisplayCalibration display = made_display(8, {40, 30}, GetParam(), -0.1);
  const Picture8 texture = noise(display.image, 1);
  EXPECT_EQ(seen(display, std::vector<Picture8>(8, texture), {0.1, 0, 0.8}, 40, 30), texture);
}

// All light comes from one point P: every module shows it where screen_from_physical says. The eye must see it where
// the line from the eye through P meets the screen. Answers the horizontal distance of the light's centre from there,
// in metres.
double point_error(const DisplayCalibration& display, Point3<Physical> p, const Eye& eye, bool reversed) {
  std::vector<Picture8> images;
  for (const auto& module : display.modules) {
    Picture8 image = black_picture(display.image.width, display.image.height);
    const auto at = image_from_physical(display, module, p);
    for (int row = 0; at && row < image.height; ++row) {
      for (int column = 0; column < image.width; ++column) {
        const double d = std::hypot(column + 0.5 - at->u, row + 0.5 - at->v) / 3;  // a soft dot
        image.rgba[4 * (std::size_t(row) * image.width + column)] = srgb8_from_linear(std::exp(-d * d));
      }
    }
    images.push_back(std::move(image));
  }
  if (reversed) std::reverse(images.begin(), images.end());
  const int width = 3 * display.image.width, height = display.image.height;
  const Picture8 picture = seen(display, images, eye, width, height);
  const double t = eye.z / (eye.z - p.z), sx = eye.x + t * (p.x - eye.x);
  double error = 0, light = 0;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const double value = linear_from_srgb(picture.rgba[4 * (std::size_t(row) * width + column)] / 255.0);
      const double x = ((column + 0.5) / width - 0.5) * display.screen.width_m;
      error += value * (x - sx) * (x - sx);
      light += value;
    }
  }
  return light > 0 ? std::sqrt(error / light) : 1;
}

TEST(DisplayViewer, PointsAtDepthGatherAtTheirPlaceInPerspectiveAsModulesGrow) {
  const Point3<Physical> p{0.03, 0.02, -0.12};
  const Eye eye{0.05, 0, 0.8};
  double before = 1;
  for (const int count : {8, 15, 31}) {
    const double error = point_error(made_display(count, {80, 60}), p, eye, false);
    EXPECT_LT(error, before) << count;
    before = error;
  }
  // The dot itself is 3 / sqrt(2) pixels of 5 mm wide = 10.6 mm; 31 modules' pitch at 12 cm adds little to that.
  EXPECT_LT(before, 0.0125);
}

TEST(DisplayViewer, ModulesInReversedOrderAreSeenToBeWrong) {
  const Point3<Physical> p{0.03, 0.02, -0.12};
  const DisplayCalibration display = made_display(31, {80, 60});
  const Eye eye{0.1, 0, 0.8};
  EXPECT_GT(point_error(display, p, eye, true), 2 * point_error(display, p, eye, false));
}

TEST(DisplayViewer, LeavesOutModulesWithoutImageOrPixel) {
  DisplayCalibration display = made_display(3, {8, 6});
  const Picture8 texture = noise(display.image, 4);
  std::vector<Picture8> images(3, texture);
  images[1] = noise(display.image, 5);
  auto pointers = all(images);
  pointers[1] = nullptr;
  EXPECT_EQ(*viewer_picture(display, pointers, {0, 0, 0.8}, 8, 6), texture);
  // A map that lands every screen point outside the image.
  display.modules[1].map = HomographyMap{glm::dmat3(1, 0, 0, 0, 1, 0, 1e6, 1e6, 1)};
  EXPECT_EQ(*viewer_picture(display, all(images), {0, 0, 0.8}, 8, 6), texture);
  const std::vector<const Picture8*> none(3, nullptr);
  EXPECT_THAT(viewer_picture(display, none, {0, 0, 0.8}, 1, 1)->rgba, testing::ElementsAre(0, 0, 0, 255));
}

TEST(DisplayViewer, RefusesWhatMakesNoPicture) {
  const DisplayCalibration display = made_display(2, {8, 6});
  const std::vector<Picture8> images(2, black_picture(8, 6)), odd(2, black_picture(8, 7));
  const auto refusal = [&](const std::vector<Picture8>& shown, Eye eye, int width) {
    return viewer_picture(display, all(shown), eye, width, 10).error().message();
  };
  EXPECT_THAT(refusal(images, {0, 0, 0}, 10), HasSubstr("not before the screen"));
  EXPECT_THAT(refusal(images, {0, std::nan(""), 1}, 10), HasSubstr("not before the screen"));
  EXPECT_THAT(refusal(images, {0, 0, 1}, 0), HasSubstr("picture: 0 x 10"));
  EXPECT_THAT(refusal(images, {0, 0, 1}, 2000000000), HasSubstr("picture: 2000000000 x 10"));
  EXPECT_THAT(refusal(odd, {0, 0, 1}, 10), HasSubstr("module 0: an image of 8 x 7"));
  EXPECT_THAT(refusal({images[0]}, {0, 0, 1}, 10), HasSubstr("1 images; the display has 2 modules"));
}

// A module that stands behind the screen's centre lights an eye before it, and none far to the side.
TEST(DisplayViewer, KnowsHowFarTheNearestLightIs) {
  DisplayCalibration display;
  display.screen = {1e-9, 1};  // a slit: one direction for each module
  display.optics.diffuser = Diffuser::kLinear;
  display.angular_scattering_rad = 0.1;
  display.modules = {{Emitter{0, 0, -1}, IdealMap{}}, {Emitter{-1, 0, -1}, IdealMap{}}};
  EXPECT_NEAR(nearest_light_rad(display, {0, 0, 2}), 0, 1e-8);
  EXPECT_NEAR(nearest_light_rad(display, {2, 0, 2}), 0, 1e-8);
  EXPECT_NEAR(nearest_light_rad(display, {-2, 0, 2}), std::atan(1.0), 1e-8);  // the slit is 1e-9 rad wide
}

TEST(DisplayContactSheet, ShowsModulesInTheirOrderAndLeavesMissingOnesOut) {
  std::vector<Picture8> images(3, black_picture(4, 2));
  for (std::size_t m = 0; m < 3; ++m) std::fill(images[m].rgba.begin(), images[m].rgba.end(), std::uint8_t(100 + m));
  auto pointers = all(images);
  pointers.insert(pointers.begin() + 1, nullptr);
  const auto sheet = contact_sheet(pointers, 2);
  ASSERT_TRUE(sheet);
  ASSERT_EQ(sheet->width, 2 * 2 + 3 * 2);
  ASSERT_EQ(sheet->height, 2 * 1 + 3 * 2);
  const auto red = [&](int x, int y) { return int(sheet->rgba[4 * (std::size_t(y) * sheet->width + x)]); };
  EXPECT_EQ(red(2, 2), 100);
  EXPECT_EQ(red(6, 2), 101);
  EXPECT_EQ(red(2, 5), 102);
  EXPECT_EQ(red(0, 0), 64);
}

TEST(DisplaySrgb, IsTheInverseOfItselfForEveryByte) {
  for (int value = 0; value < 256; ++value) EXPECT_EQ(srgb8_from_linear(linear_from_srgb8()[value]), value);
}

}  // namespace
}  // namespace lfd::display
