// Made displays: the numbers of the design's table, the rule of scattering, and perturbations of realistic size.
#include "calibration/make.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lfd {
namespace {

TEST(MakeDisplay, HasTheNumbersOfTheTable) {
  const DisplayCalibration d = *make_display("640rc");
  EXPECT_EQ(d.modules.size(), 64u);
  EXPECT_EQ(d.image, (ImageSize{1024, 768}));
  EXPECT_EQ(d.screen, (ScreenSize{1.59, 0.90}));
  EXPECT_EQ(d.optics, (Optics{Diffuser::kLinear, 0, 3}));
  const double half_span = 1.8 * std::tan(30 * std::numbers::pi / 180);
  EXPECT_NEAR(d.modules.front().emitter.x, -half_span, 1e-12);
  EXPECT_NEAR(d.modules.back().emitter.x, half_span, 1e-12);
  const double pitch = 2 * half_span / 63;
  for (std::size_t k = 0; k < d.modules.size(); ++k) {
    EXPECT_NEAR(d.modules[k].emitter.x, -half_span + static_cast<double>(k) * pitch, 2e-12);
    EXPECT_EQ(d.modules[k].emitter.y, 0);
    EXPECT_EQ(d.modules[k].emitter.z, -1.8);
  }
  EXPECT_NEAR(d.angular_scattering_rad, 1.5 * 2 * std::atan(0.5 * pitch / 1.8), 2e-12);
}

TEST(MakeDisplay, AllNamesHaveTheNumbersOfTheTable) {
  struct Row {
    const char* name;
    std::size_t modules;
    ImageSize image;
    ScreenSize screen;
    double fov_deg, vz, ez;
  };
  for (const Row& row : {Row{"desk", 8, {256, 192}, {0.40, 0.30}, 40, 0.8, -0.6},
                         Row{"128wld", 128, {320, 240}, {0.65, 0.49}, 50, 1.2, -0.9},
                         Row{"crs4", 72, {800, 600}, {1.60, 0.90}, 50, 3.0, -1.8},
                         Row{"640rc", 64, {1024, 768}, {1.59, 0.90}, 60, 3.0, -1.8},
                         Row{"722rc", 72, {1280, 800}, {1.59, 0.99}, 70, 3.0, -1.8},
                         Row{"c80", 80, {1024, 768}, {3.00, 1.80}, 40, 7.0, -6.0},
                         Row{"c80-conical", 80, {1024, 768}, {3.00, 1.80}, 40, 7.0, -6.0}}) {
    const DisplayCalibration d = *make_display(row.name);
    EXPECT_EQ(d.modules.size(), row.modules) << row.name;
    EXPECT_EQ(d.image, row.image) << row.name;
    EXPECT_EQ(d.screen, row.screen) << row.name;
    EXPECT_EQ(d.optics.observer_distance_m, row.vz) << row.name;
    EXPECT_EQ(d.modules.front().emitter.z, row.ez) << row.name;
    const double half_span = -row.ez * std::tan(row.fov_deg / 2 * std::numbers::pi / 180);
    EXPECT_NEAR(d.modules.front().emitter.x, -half_span, 1e-12) << row.name;
    EXPECT_NEAR(d.modules.back().emitter.x, half_span, 1e-12) << row.name;
  }
}

TEST(MakeDisplay, EveryNameMakesAValidDisplay) {
  for (const std::string& name : display_names()) {
    const auto display = make_display(name);
    ASSERT_TRUE(display);
    EXPECT_EQ(display->name, name);
    EXPECT_TRUE(validate(*display));
  }
  EXPECT_EQ(display_names().size(), 7u);
  EXPECT_EQ(make_display("c80-conical")->optics.diffuser, Diffuser::kConical);
  EXPECT_EQ(make_display("c80-conical")->modules[7].emitter.y, -1.2);
}

TEST(MakeDisplay, OtherNumbersOfModulesKeepTheSpan) {
  const DisplayCalibration many = *make_display("desk"), three = *make_display("desk", 3),
                           one = *make_display("desk", 1);
  EXPECT_EQ(three.modules.front(), many.modules.front());
  EXPECT_EQ(three.modules.back(), many.modules.back());
  EXPECT_EQ(three.modules[1].emitter.x, 0);
  EXPECT_NEAR(three.angular_scattering_rad, 1.5 * 20 * std::numbers::pi / 180, 1e-12);
  EXPECT_EQ(one.modules[0].emitter.x, 0);
  EXPECT_TRUE(validate(one));
  EXPECT_FALSE(make_display("desk", 0));
  EXPECT_FALSE(make_display("desk", 1025));
  EXPECT_FALSE(make_display("table"));
}

TEST(PinholeOfIdeal, AgreesWithTheIdealMap) {
  for (const std::string& name : display_names()) {
    const DisplayCalibration display = *make_display(name);
    for (const auto& module : display.modules) {
      const PinholeMap map = pinhole_of_ideal(display.screen, display.image, module.emitter);
      for (const ScreenPoint s : {ScreenPoint{0, 0}, ScreenPoint{0.1, -0.07}, ScreenPoint{-0.2, 0.15}}) {
        const auto p = image_from_screen(map, s);
        const PixelPoint ideal = image_from_screen(IdealMap{}, display.screen, display.image, s);
        ASSERT_TRUE(p);
        EXPECT_NEAR(p->x, ideal.x, 1e-11);
        EXPECT_NEAR(p->y, ideal.y, 1e-11);
      }
    }
  }
}

TEST(Perturbed, MovesPixelsByWhatInstallationsDo) {
  for (const std::string& name : display_names()) {
    const DisplayCalibration ideal = *make_display(name), display = perturbed(ideal, 1);
    ASSERT_TRUE(validate(display));
    double sum = 0, most = 0;
    int lit = 0, points = 0;
    for (const auto& module : display.modules) {
      const auto& map = std::get<PinholeMap>(module.map);
      EXPECT_EQ(map.position, module.emitter);
      EXPECT_NE(map.k1, 0);
      EXPECT_NE(map.p2, 0);
      for (double x = -0.49; x < 0.5; x += 0.14) {
        for (double y = -0.49; y < 0.5; y += 0.14) {
          const ScreenPoint s{x * display.screen.width_m, y * display.screen.height_m};
          const auto p = image_from_screen(map, s);
          ASSERT_TRUE(p);
          const PixelPoint before = image_from_screen(IdealMap{}, ideal.screen, ideal.image, s);
          const double moved = std::hypot(p->x - before.x, p->y - before.y);
          sum += moved;
          most = std::max(most, moved);
          ++points;
          lit += image_from_screen(display, module, s) ? 1 : 0;
        }
      }
    }
    const double width = display.image.width;
    EXPECT_GT(sum / points, 0.003 * width) << name;  // several pixels of 1024
    EXPECT_LT(most, 0.04 * width) << name;
    EXPECT_GT(static_cast<double>(lit) / points, 0.98) << name;
  }
}

TEST(Perturbed, IsTheSameForTheSameSeedOnly) {
  const DisplayCalibration display = *make_display("desk");
  EXPECT_EQ(perturbed(display, 5), perturbed(display, 5));
  EXPECT_NE(perturbed(display, 5), perturbed(display, 6));
}

TEST(Measured, RefusesTooManyPointsAtOnce) {
  const auto refusal = [](int modules, int columns, int rows) {
    const auto made = measured(*make_display("desk", modules), columns, rows, 0, 1);
    return made ? "" : made.error().message();
  };
  EXPECT_EQ(refusal(2, 1'000'000, 1'000'000), "1000000 x 1000000 points; 2 to 4096 a side are possible");
  EXPECT_EQ(refusal(2, 1, 5), "1 x 5 points; 2 to 4096 a side are possible");
  EXPECT_EQ(refusal(1024, 4096, 4096),
            "4096 x 4096 points of 1024 modules are 17179869184 in all; at most 16777216 are possible");
  EXPECT_EQ(refusal(2, 12, 9), "");
}

}  // namespace
}  // namespace lfd
