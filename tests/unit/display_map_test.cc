// The whole map, optics and module together: known answers, pixel lines and limits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "calibration/display.h"
#include "calibration/make.h"

namespace lfd {
namespace {

DisplayCalibration one_module(Diffuser diffuser) {
  DisplayCalibration display;
  display.screen = {2, 1};
  display.image = {200, 100};
  display.optics = {diffuser, 0.5, 4};
  display.angular_scattering_rad = 0.1;
  display.modules = {{{0.2, -0.3, -2}, IdealMap{}}};
  return display;
}

TEST(DisplayMap, LinearKnownAnswer) {
  const DisplayCalibration display = one_module(Diffuser::kLinear);
  // z = 1: sy = 0.5 + (0.2 - 0.5) 4/3 = 0.1; sx = 0.2 + (0.5 - 0.2) 2/3 = 0.4; 100 px a metre.
  const auto p = image_from_physical(display, display.modules[0], {0.5, 0.2, 1});
  ASSERT_TRUE(p);
  EXPECT_NEAR(p->u, 140, 1e-12);
  EXPECT_NEAR(p->v, 40, 1e-12);
  EXPECT_EQ(p->z, 1);
}

TEST(DisplayMap, ConicalKnownAnswer) {
  const DisplayCalibration display = one_module(Diffuser::kConical);
  // sy = 0.1 as above; k = sqrt(0.4^2 + 4^2) / sqrt(0.4^2 + 2^2); sx = (x + ex k z / vz) / (1 + k z / vz).
  const double k = std::sqrt(16.16) / std::sqrt(4.16);
  const double sx = (0.5 + 0.2 * k / 4) / (1 + k / 4);
  const auto p = image_from_physical(display, display.modules[0], {0.5, 0.2, 1});
  ASSERT_TRUE(p);
  EXPECT_NEAR(p->u, 100 + 100 * sx, 1e-12);
  EXPECT_NEAR(p->v, 40, 1e-12);
}

TEST(DisplayMap, RaysKnownAnswer) {
  for (const Diffuser diffuser : {Diffuser::kLinear, Diffuser::kConical}) {
    const DisplayCalibration display = one_module(diffuser);
    const auto line = pixel_line(display, display.modules[0], {140, 40});
    ASSERT_TRUE(line);
    EXPECT_NEAR(line->on_screen.x, 0.4, 1e-15);
    EXPECT_NEAR(line->on_screen.y, 0.1, 1e-15);
    EXPECT_EQ(line->on_screen.z, 0);
    // linear: ox = sx - (sx - ex) vz / ez; conical: ox = sx + rho sqrt((vy - sy)^2 + vz^2)
    const double expected =
        diffuser == Diffuser::kLinear ? 0.4 + 0.2 * 4 / 2 : 0.4 + 0.2 / std::sqrt(4.16) * std::sqrt(16.16);
    EXPECT_NEAR(line->on_observer_line.x, expected, 1e-14);
    EXPECT_EQ(line->on_observer_line.y, 0.5);
    EXPECT_EQ(line->on_observer_line.z, 4);
  }
}

TEST(DisplayMap, PointsOfAPixelsLineLandInThePixel) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const char* name : {"desk", "c80-conical"}) {
    for (const bool is_perturbed : {false, true}) {
      const DisplayCalibration made = *make_display(name), display = is_perturbed ? perturbed(made, 3) : made;
      for (int i = 0; i < 2000; ++i) {
        const ModuleCalibration& module = display.modules[random() % display.modules.size()];
        const PixelPoint pixel{unit(random) * display.image.width, unit(random) * display.image.height};
        const auto line = pixel_line(display, module, pixel);
        if (!line) continue;  // a pixel beside the screen
        const double nearest = line->singular_depth;
        const double z = 0.9 * nearest + unit(random) * 0.9 * (display.optics.observer_distance_m - nearest);
        const double t = z / display.optics.observer_distance_m;
        const auto p =
            image_from_physical(display, module, line->on_screen + t * (line->on_observer_line - line->on_screen));
        if (!p) {
          // Rounding may push a point of the border over it.
          const ScreenPoint s{line->on_screen.x, line->on_screen.y};
          EXPECT_LT(std::min(display.screen.width_m / 2 - std::abs(s.x), display.screen.height_m / 2 - std::abs(s.y)),
                    1e-9);
          continue;
        }
        // 1e-9 px: 1e3 px, a condition of up to 1e2 near the singular planes, and some 1e-14.
        EXPECT_NEAR(p->u, pixel.x, 1e-9);
        EXPECT_NEAR(p->v, pixel.y, 1e-9);
      }
    }
  }
}

TEST(DisplayMap, NothingOffTheScreenOrTheImageIsAnswered) {
  const DisplayCalibration display = one_module(Diffuser::kLinear);
  const ModuleCalibration& module = display.modules[0];
  EXPECT_TRUE(image_from_screen(display, module, {1, 0.5}));
  EXPECT_FALSE(image_from_screen(display, module, {1.0001, 0}));
  EXPECT_FALSE(image_from_screen(display, module, {0, -0.5001}));
  EXPECT_FALSE(image_from_screen(display, module, {NAN, 0}));
  EXPECT_TRUE(screen_from_image(display, module, {200, 100}));
  EXPECT_FALSE(screen_from_image(display, module, {200.1, 50}));
  EXPECT_FALSE(screen_from_image(display, module, {-0.1, 50}));
  EXPECT_FALSE(screen_from_image(display, module, {50, NAN}));
  EXPECT_FALSE(image_from_physical(display, module, {0, 0, 4}));
  EXPECT_FALSE(image_from_physical(display, module, {0, 0, -2}));
  EXPECT_FALSE(image_from_physical(display, module, {INFINITY, 0, 0}));
}

}  // namespace
}  // namespace lfd
