// The optics forward and backward: properties over random displays, and the validity limits.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "calibration/optics.h"

namespace lfd {
namespace {

struct RandomDisplay {
  Optics optics;
  Emitter emitter;
};

RandomDisplay random_display(std::mt19937& random, Diffuser diffuser) {
  std::uniform_real_distribution<double> side(-1, 1), distance(0.5, 5);
  return {{diffuser, 0.5 * side(random), distance(random)}, {side(random), side(random), -distance(random)}};
}

class OpticsOf : public testing::TestWithParam<Diffuser> {};

TEST_P(OpticsOf, PointsOfAPixelsLineAreShownByItsScreenPoint) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 20000; ++i) {
    const auto [optics, emitter] = random_display(random, GetParam());
    const ScreenPoint s{unit(random) - 0.5, unit(random) - 0.5};
    const auto line = line_of_screen_point(optics, emitter, s);
    ASSERT_TRUE(line);
    const double behind = line->singular_depth / optics.observer_distance_m;
    const double t = behind + (1 - behind) * (0.01 + 0.98 * unit(random));
    const Point3<Physical> p = line->on_screen + t * (line->on_observer_line - line->on_screen);
    const auto back = screen_from_physical(optics, emitter, p);
    ASSERT_TRUE(back) << "z = " << p.z;
    // 1e-11: the map's own condition number is at most 1e2 at 1 % from a singular plane, times some 1e-14 of rounding.
    EXPECT_NEAR(back->x, s.x, 1e-11);
    EXPECT_NEAR(back->y, s.y, 1e-11);
  }
}

TEST_P(OpticsOf, PointsOnTheScreenStayWhereTheyAre) {
  std::mt19937 random(2);
  for (int i = 0; i < 1000; ++i) {
    const auto [optics, emitter] = random_display(random, GetParam());
    const auto s = screen_from_physical(optics, emitter, {0.3, -0.2, 0});
    ASSERT_TRUE(s);
    EXPECT_NEAR(s->x, 0.3, 1e-15);
    EXPECT_NEAR(s->y, -0.2, 1e-15);
  }
}

TEST_P(OpticsOf, NothingBehindTheEmitterOrBeforeTheObserverHasAnImage) {
  const Optics optics{GetParam(), 0, 3};
  const Emitter emitter{0.1, -0.3, -1.8};
  EXPECT_FALSE(screen_from_physical(optics, emitter, {0, 0, -1.8}));
  EXPECT_FALSE(screen_from_physical(optics, emitter, {0, 0, -2}));
  EXPECT_FALSE(screen_from_physical(optics, emitter, {0, 0, 3}));
  EXPECT_FALSE(screen_from_physical(optics, emitter, {0, 0, 4}));
  EXPECT_FALSE(screen_from_physical(optics, emitter, {NAN, 0, 0}));
  EXPECT_FALSE(screen_from_physical(optics, emitter, {0, 0, NAN}));
  EXPECT_FALSE(screen_from_physical(optics, emitter, {0, INFINITY, 0.5}));
}

INSTANTIATE_TEST_SUITE_P(Diffusers, OpticsOf, testing::Values(Diffuser::kLinear, Diffuser::kConical),
                         [](const auto& parameter) {
                           return parameter.param == Diffuser::kLinear ? "Linear" : "Conical";
                         });

TEST(Optics, DiffusersAgreeWhereTheirConvergenceIsTheSame) {
  const Emitter emitter{0.4, 0, -2};
  const Optics linear{Diffuser::kLinear, 0, 2}, conical{Diffuser::kConical, 0, 2};
  for (double z : {-1.5, -0.3, 0.7, 1.9}) {
    const auto a = screen_from_physical(linear, emitter, {0.2, 0.1, z});
    const auto b = screen_from_physical(conical, emitter, {0.2, 0.1, z});
    ASSERT_TRUE(a && b);
    EXPECT_NEAR(a->x, b->x, 1e-12);
    EXPECT_NEAR(a->y, b->y, 1e-12);
  }
}

TEST(Optics, TheWrongDiffuserMovesAPointByNinePixels) {
  // The figure of the design: 20 cm before a 1.6 x 0.9 m screen of 1280 pixels, vz 3.0, ez -1.8, emitter 0.3 m low.
  // Points within the screen's rectangle, emitters up to 0.1 m beside it.
  double worst_px = 0;
  for (double ex = -0.9; ex <= 0.9; ex += 0.05) {
    for (double x = -0.8; x <= 0.8; x += 0.05) {
      for (double y = -0.45; y <= 0.45; y += 0.05) {
        const auto a = screen_from_physical({Diffuser::kLinear, 0, 3}, {ex, -0.3, -1.8}, {x, y, 0.2});
        const auto b = screen_from_physical({Diffuser::kConical, 0, 3}, {ex, -0.3, -1.8}, {x, y, 0.2});
        ASSERT_TRUE(a && b);
        worst_px = std::max(worst_px, std::abs(a->x - b->x) * 1280 / 1.6);
      }
    }
  }
  EXPECT_NEAR(worst_px, 9, 0.5);
}

TEST(Optics, ConicalPointsBehindTheMeetingPointAreRefused) {
  const Optics optics{Diffuser::kConical, 0, 3};
  const Emitter emitter{0, 0, -6};  // far away: the lines meet at about -6, nearer for points far above
  const double z = line_of_screen_point({Diffuser::kConical, 0, 3}, {0, 0, -1}, {0, 0.8})->singular_depth;
  EXPECT_GT(z, -1.3);
  EXPECT_FALSE(screen_from_physical(optics, emitter, {0, 0, -6.1}));
}

TEST(Optics, RefusesObserverBehindAndEmitterBeforeTheScreen) {
  EXPECT_TRUE(validate(Optics{Diffuser::kLinear, 0, 1}));
  EXPECT_TRUE(validate(Emitter{0, 0, -1}));
  EXPECT_FALSE(validate(Optics{Diffuser::kLinear, 0, 0}));
  EXPECT_FALSE(validate(Optics{Diffuser::kLinear, 0, -1}));
  EXPECT_FALSE(validate(Optics{Diffuser::kLinear, 0, INFINITY}));
  EXPECT_FALSE(validate(Optics{Diffuser::kLinear, NAN, 1}));
  EXPECT_FALSE(validate(Emitter{0, 0, 0}));
  EXPECT_FALSE(validate(Emitter{0, 0, 1}));
  EXPECT_FALSE(validate(Emitter{NAN, 0, -1}));
}

}  // namespace
}  // namespace lfd
