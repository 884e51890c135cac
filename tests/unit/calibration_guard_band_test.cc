// Displays with a guard band: every map is the one before, moved, and the screen reaches as far as the band.
#include "calibration/guard_band.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/reference/scene_maker.h"
#include "tests/support/unwrapped.h"
#include "tests/unit/rendernode_displays.h"

namespace lfd {
namespace {

using testing_support::MapKind;
using testing_support::Random;
using testing_support::random_display;
using testing_support::uniform;
using testing_support::unwrapped;

std::vector<DisplayCalibration> displays() {
  Random random(7);
  std::vector<DisplayCalibration> all;
  for (const Diffuser diffuser : testing_support::kDiffusers) {
    for (const MapKind kind : testing_support::kMapKinds) all.push_back(random_display(diffuser, kind, random));
  }
  const DisplayCalibration linear = random_display(Diffuser::kLinear, MapKind::kIdeal, random);
  all.push_back(unwrapped(measured(perturbed(linear, 2), 16, 12, 2.0, 3)));
  all.push_back(unwrapped(curved(linear, 1.2, false)));
  all.push_back(unwrapped(curved(perturbed(linear, 4), -4, true)));
  return all;
}

TEST(CalibrationGuardBand, MovesEveryMap) {
  constexpr int kBand_px = 48;
  Random random(1);
  for (const DisplayCalibration& display : displays()) {
    const DisplayCalibration larger = with_guard_band(display, kBand_px);
    EXPECT_EQ(larger.image, (ImageSize{display.image.width + 2 * kBand_px, display.image.height + 2 * kBand_px}));
    EXPECT_EQ(larger.optics, display.optics);
    int there = 0;
    for (int i = 0; i < 300; ++i) {
      const std::size_t k = static_cast<std::size_t>(i) % display.modules.size();
      const ModuleCalibration &module = display.modules[k], &moved = larger.modules[k];
      EXPECT_EQ(moved.emitter, module.emitter);
      const ScreenPoint s{uniform(random, -0.5, 0.5) * display.screen.width_m,
                          uniform(random, -0.5, 0.5) * display.screen.height_m};
      const auto before = image_from_screen(display, module, s), after = image_from_screen(larger, moved, s);
      if (!before) continue;
      ASSERT_TRUE(after) << "what had a pixel has one";
      ++there;
      EXPECT_NEAR(after->x, before->x + kBand_px, 1e-9);
      EXPECT_NEAR(after->y, before->y + kBand_px, 1e-9);
      const auto back = screen_from_image(larger, moved, *after);
      ASSERT_TRUE(back);
      EXPECT_NEAR(back->x, s.x, 1e-9);
      EXPECT_NEAR(back->y, s.y, 1e-9);
    }
    EXPECT_GT(there, 150);
  }
}

TEST(CalibrationGuardBand, OfIdealMapsTheScreenGrowsAsTheImage) {
  const DisplayCalibration display = unwrapped(make_display("desk"));
  const DisplayCalibration larger = with_guard_band(display, 32);
  EXPECT_DOUBLE_EQ(larger.screen.width_m, display.screen.width_m * (256 + 64) / 256);
  EXPECT_DOUBLE_EQ(larger.screen.height_m, display.screen.height_m * (192 + 64) / 192);
  const auto corner = image_from_screen(larger, larger.modules[3],
                                        {-0.4999999 * larger.screen.width_m, 0.4999999 * larger.screen.height_m});
  ASSERT_TRUE(corner);
  EXPECT_NEAR(corner->x, 0, 1e-3);
  EXPECT_NEAR(corner->y, 0, 1e-3);
}

// Of the images themselves, where they reach beyond the screen, no further than the band would.
TEST(CalibrationGuardBand, TheScreenCoversTheBand) {
  constexpr int kBand_px = 48;
  for (const DisplayCalibration& display : displays()) {
    const DisplayCalibration larger = with_guard_band(display, kBand_px);
    const double most_m = display.screen.width_m * (1 + 4.0 * kBand_px / display.image.width);
    EXPECT_GT(larger.screen.width_m, display.screen.width_m);
    EXPECT_LE(larger.screen.width_m, 1.0000001 * most_m);
    for (const ModuleCalibration& module : larger.modules) {
      for (int i = 0; i <= 200; ++i) {
        for (const double v : {0.0, 1.0}) {
          const auto s = lit_by(larger, module.map, {larger.image.width * i / 200.0, larger.image.height * v});
          if (!s) continue;  // beside what a grid measured
          const double reach_m = std::min(2 * std::abs(s->x), most_m);
          EXPECT_LE(reach_m, larger.screen.width_m * (1 + 1e-6)) << display.name;
        }
      }
    }
  }
}

TEST(CalibrationGuardBand, ScreensStayOnHalfOfTheirCylinder) {
  DisplayCalibration display = unwrapped(make_display("desk"));
  display.optics.screen_radius_m = 0.15;  // the screen of 0.4 m is 85 % of half of its circumference
  const DisplayCalibration larger = with_guard_band(display, 128);
  EXPECT_LT(larger.screen.width_m, std::numbers::pi * 0.15);
  EXPECT_GT(larger.screen.width_m, display.screen.width_m);
}

TEST(CalibrationGuardBand, ImagesMustStayWithinTheLimit) {
  EXPECT_TRUE(check_guard_band({8192, 8192}, 0));
  EXPECT_TRUE(check_guard_band({8064, 600}, 63)) << "64 are drawn";
  EXPECT_TRUE(check_guard_band({600, 8064}, 64));
  EXPECT_FALSE(check_guard_band({600, 8064}, 65));
  EXPECT_EQ(check_guard_band({8064, 600}, 66).error().message(),
            "images of 8064x600 px become 8196x732 with a guard band of 66 px; at most 8192 px a side are possible");
}

}  // namespace
}  // namespace lfd
