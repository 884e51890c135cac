// Cylindrical screens: forward and backward agree, known rays, the limit of a plane, and where there is no image.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "calibration/curved_screen.h"
#include "calibration/optics.h"

namespace lfd {
namespace {

using testing::HasSubstr;

Optics curved(double radius_m, bool arc, double vy = 0.1, double vz = 3) {
  return {Diffuser::kLinear, vy, vz, radius_m, arc};
}

TEST(CurvedScreen, ArcLengthsAreThoseOfTheCircle) {
  for (const double radius : {0.9, -0.9, 5.0, -5.0}) {
    const CurvedScreen screen(radius);
    for (const double s : {-1.2, -0.3, 0.0, 0.7, 1.3}) {
      const glm::dvec2 q = screen.point_at(s);
      EXPECT_NEAR(glm::length(q - glm::dvec2(0, -radius)), std::abs(radius), 1e-15 * 10);
      EXPECT_NEAR(screen.level(q), 0, 1e-15);
      EXPECT_NEAR(screen.arc_length_of(q).value(), s, 1e-14);
      EXPECT_EQ(q.x > 0, s > 0);
      EXPECT_EQ(q.y<0, radius> 0 && s != 0) << "a convex screen bends away from the viewer";
    }
  }
}

struct Case {
  double radius;
  bool arc;
};

class CurvedOptics : public testing::TestWithParam<Case> {
 protected:
  // A display of the size of a room, somewhat at random.
  static Emitter emitter(std::mt19937& random) {
    std::uniform_real_distribution<double> unit(-1, 1);
    const double x = 0.8 * unit(random), y = 0.3 * unit(random);
    return {x, y, -1.8 + 0.3 * unit(random)};
  }
  Optics optics() const { return curved(GetParam().radius, GetParam().arc); }
};
INSTANTIATE_TEST_SUITE_P(Screens, CurvedOptics,
                         testing::Values(Case{2.5, false}, Case{2.5, true}, Case{-4, false}, Case{-4, true},
                                         Case{1.0, false}, Case{1e3, true}, Case{-1e3, false}),
                         [](const auto& one) {
                           return std::string(one.param.radius > 0 ? "Convex" : "Concave") +
                                  std::to_string(int(std::abs(one.param.radius))) + (one.param.arc ? "Arc" : "Line");
                         });

TEST_P(CurvedOptics, PointsOfAPixelsLineAreShownByItsScreenPoint) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  int compared = 0;
  for (int i = 0; i < 20000; ++i) {
    const Emitter e = emitter(random);
    const ScreenPoint s{1.4 * (unit(random) - 0.5), unit(random) - 0.5};
    const auto line = line_of_screen_point(optics(), e, s);
    if (!line) continue;
    const double behind = line->singular_depth / optics().observer_distance_m;
    const double t = behind + (1 - behind) * (0.01 + 0.98 * unit(random));
    const Point3<Physical> p = line->on_screen + t * (line->on_observer_line - line->on_screen);
    const auto back = on_screen(optics(), e, p);
    ASSERT_TRUE(back) << p.x << " " << p.y << " " << p.z;
    ++compared;
    // The condition is at most 1e2 at 1 % from a singular place, of rounding of some 1e-15 in lengths and angles. Rays
    // that graze the screen are up to another 1e2 more sensitive.
    EXPECT_NEAR(back->at.x, s.x, 1e-11);
    EXPECT_NEAR(back->at.y, s.y, 1e-11);
    EXPECT_NEAR(back->depth, t * optics().observer_distance_m, 1e-11);
    EXPECT_NEAR(back->w, w_at_depth(optics(), e, s, back->depth), 1e-11);
    EXPECT_GT(back->w, 0);
  }
  EXPECT_GT(compared, 5000);
}

// Emitter and observer are where geometry says: the line's horizontal course passes the emitter, its end the observers.
TEST_P(CurvedOptics, LinesComeFromTheEmitterAndEndAtTheObservers) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(-0.7, 0.7);
  for (int i = 0; i < 5000; ++i) {
    const Emitter e = emitter(random);
    const auto line = line_of_screen_point(optics(), e, {unit(random), unit(random)});
    if (!line) continue;
    const glm::dvec2 from(e.x, e.z), at(line->on_screen.x, line->on_screen.z),
        to(line->on_observer_line.x, line->on_observer_line.z);
    const glm::dvec2 one = glm::normalize(at - from), other = glm::normalize(to - at);
    EXPECT_NEAR(one.x * other.y - one.y * other.x, 0, 1e-12) << "one straight line seen from above";
    EXPECT_GT(glm::dot(one, other), 0);
    EXPECT_EQ(line->on_observer_line.y, optics().observer_height_m);
    const double vz = optics().observer_distance_m, radius = GetParam().radius;
    if (GetParam().arc) {
      EXPECT_NEAR(glm::length(to - glm::dvec2(0, -radius)), std::abs(radius + vz), 1e-12 * (std::abs(radius) + 10));
    } else {
      EXPECT_NEAR(to.y, vz, 1e-12);
    }
  }
}

// What differs from the plane falls as 1 / radius; at 1e9 m nothing is left but rounding.
TEST(CurvedOptics, GoOverIntoThePlanarScreen) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 2000; ++i) {
    const Emitter e{0.8 * unit(random), 0.3 * unit(random), -1.8};
    const Point3<Physical> p{0.5 * unit(random), 0.3 * unit(random), 0.8 * unit(random)};
    const auto plane = on_screen({Diffuser::kLinear, 0.1, 3}, e, p);
    ASSERT_TRUE(plane);
    for (const double radius : {1e3, 1e6, 1e9, -1e3, -1e6, -1e9}) {
      for (const bool arc : {false, true}) {
        const auto bent = on_screen(curved(radius, arc), e, p);
        ASSERT_TRUE(bent);
        // Sagittas of x^2 / 2 R for x of up to 6 m; 1e-14 is rounding.
        const double tolerance = 20 / std::abs(radius) + 1e-13;
        EXPECT_NEAR(bent->at.x, plane->at.x, tolerance);
        EXPECT_NEAR(bent->at.y, plane->at.y, tolerance);
        EXPECT_NEAR(bent->depth, plane->depth, tolerance);
        EXPECT_NEAR(bent->w, plane->w, tolerance);
      }
    }
  }
}

// In the middle plane of a symmetric display everything is as on a planar screen.
TEST(CurvedOptics, StraightAheadNothingBends) {
  const auto found = on_screen(curved(2, false, 0, 3), {0, 0, -1.5}, {0, 0.2, 1});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->at.x, 0, 1e-16);
  EXPECT_NEAR(found->at.y, 0.2 * 3 / 2, 1e-15);
  EXPECT_NEAR(found->depth, 1, 1e-15);
  EXPECT_NEAR(found->w, 2.5 / 1.5, 1e-15);
}

TEST(CurvedOptics, HaveNoImageWhereNoRayComesFrom) {
  const Optics convex = curved(1, false);
  const Emitter e{0, 0, -0.5};  // within the cylinder
  EXPECT_TRUE(screen_from_physical(convex, e, {0.2, 0, 0.5}));
  EXPECT_FALSE(screen_from_physical(convex, e, {0.2, 0, -0.5})) << "the ray runs along the screen, never to a viewer";
  EXPECT_FALSE(screen_from_physical(convex, e, {0, 0, -0.9})) << "behind the emitter: it would light the other half";
  EXPECT_FALSE(screen_from_physical(convex, e, {0, 0, -0.5})) << "the emitter itself";
  EXPECT_FALSE(screen_from_physical(convex, e, {0.2, 0, 3.1})) << "behind the observers";
  EXPECT_FALSE(screen_from_physical(curved(-4, false), {0, 0, -1.8}, {50, 0, -1.7})) << "it misses the arc";
  EXPECT_FALSE(screen_from_physical(convex, e, {NAN, 0, 0.5}));
  EXPECT_FALSE(screen_from_physical(convex, e, {0.2, INFINITY, 0.5}));
  EXPECT_FALSE(line_of_screen_point(convex, {2, 0, -1.5}, {1.5, 0})) << "it turns its back to the emitter";
}

TEST(CurvedOptics, AreRefusedByNameWhereTheyCannotBe) {
  EXPECT_TRUE(validate(curved(2, false)));
  EXPECT_TRUE(validate(curved(-2, false)));
  EXPECT_TRUE(validate(curved(-4, true)));
  Optics conical = curved(2, false);
  conical.diffuser = Diffuser::kConical;
  EXPECT_THAT(validate(conical).error().message(), HasSubstr("CONICAL on a curved screen is not supported"));
  EXPECT_THAT(validate(curved(-2, true)).error().message(), HasSubstr("beyond the axis"));
  EXPECT_THAT(validate(curved(0, true)).error().message(), HasSubstr("observer_arc"));
  EXPECT_THAT(validate(curved(NAN, false)).error().message(), HasSubstr("screen_radius_m"));
}

}  // namespace
}  // namespace lfd
