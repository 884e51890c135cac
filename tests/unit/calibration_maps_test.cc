// Homography and pinhole maps: round trips, an independent Brown-Conrady, derivatives, and the limits of both.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "calibration/maps/homography.h"
#include "calibration/maps/pinhole.h"

namespace lfd {
namespace {

HomographyMap random_homography(std::mt19937& random) {
  std::uniform_real_distribution<double> small(-0.1, 0.1);
  HomographyMap map;
  map.image_from_screen = glm::dmat3({900 + 100 * small(random), 100 * small(random), small(random)},
                                     {100 * small(random), -900 + 100 * small(random), small(random)},
                                     {500 + 100 * small(random), 300 + 100 * small(random), 1});
  return map;
}

PinholeMap random_pinhole(std::mt19937& random) {
  std::uniform_real_distribution<double> small(-1, 1);
  PinholeMap map;
  map.position = {small(random), 0.3 * small(random), -1.8 + 0.2 * small(random)};
  map.orientation = glm::normalize(glm::dquat(1, 0.05 * small(random), 0.05 * small(random), 0.05 * small(random)));
  map.focal_u_px = 1000 + 100 * small(random);
  map.focal_v_px = 1000 + 100 * small(random);
  map.principal_u_px = 500 + 100 * small(random);
  map.principal_v_px = 400 + 100 * small(random);
  map.k1 = 0.02 * small(random);
  map.k2 = 0.005 * small(random);
  map.k3 = 0.001 * small(random);
  map.p1 = 0.002 * small(random);
  map.p2 = 0.002 * small(random);
  return map;
}

ScreenPoint random_screen_point(std::mt19937& random) {
  std::uniform_real_distribution<double> side(-1, 1);
  return {0.8 * side(random), 0.45 * side(random)};
}

// The model written down a second time, from OpenCV's documentation, with the rotation spelt out by the quaternion's
// action.
std::array<double, 2> reference_pinhole(const PinholeMap& m, ScreenPoint s) {
  const double w = m.orientation.w, qx = -m.orientation.x, qy = -m.orientation.y,
               qz = -m.orientation.z;  // inverse turn
  const double dx = s.x - m.position.x, dy = s.y - m.position.y, dz = -m.position.z;
  const double X = (1 - 2 * (qy * qy + qz * qz)) * dx + 2 * (qx * qy - w * qz) * dy + 2 * (qx * qz + w * qy) * dz;
  const double Y = 2 * (qx * qy + w * qz) * dx + (1 - 2 * (qx * qx + qz * qz)) * dy + 2 * (qy * qz - w * qx) * dz;
  const double Z = 2 * (qx * qz - w * qy) * dx + 2 * (qy * qz + w * qx) * dy + (1 - 2 * (qx * qx + qy * qy)) * dz;
  const double x = X / Z, y = -Y / Z;
  const double r2 = x * x + y * y, r4 = r2 * r2, r6 = r4 * r2;
  const double radial = 1 + m.k1 * r2 + m.k2 * r4 + m.k3 * r6;
  const double xd = x * radial + 2 * m.p1 * x * y + m.p2 * (r2 + 2 * x * x);
  const double yd = y * radial + m.p1 * (r2 + 2 * y * y) + 2 * m.p2 * x * y;
  return {m.focal_u_px * xd + m.principal_u_px, m.focal_v_px * yd + m.principal_v_px};
}

TEST(Homography, GoesThereAndBack) {
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    const HomographyMap map = random_homography(random);
    ASSERT_TRUE(validate(map));
    const ScreenPoint s = random_screen_point(random);
    const auto p = image_from_screen(map, s);
    ASSERT_TRUE(p);
    const auto back = screen_from_image(map, *p);
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->x, s.x, 1e-13);  // condition about 1e3 times rounding
    EXPECT_NEAR(back->y, s.y, 1e-13);
  }
}

TEST(Homography, KnownAnswer) {
  const HomographyMap map{glm::dmat3({2, 0, 0.5}, {0, -4, 0}, {10, 20, 1})};
  const auto p = image_from_screen(map, {2, 1});
  ASSERT_TRUE(p);
  EXPECT_DOUBLE_EQ(p->x, 7);  // (2 * 2 + 10) / (0.5 * 2 + 1)
  EXPECT_DOUBLE_EQ(p->y, 8);  // (-4 + 20) / 2
}

TEST(Homography, HasNoImageOnOrBehindItsHorizon) {
  const HomographyMap map{glm::dmat3({1, 0, 1}, {0, 1, 0}, {0, 0, 1})};
  EXPECT_TRUE(image_from_screen(map, {-0.5, 0}));
  EXPECT_FALSE(image_from_screen(map, {-1, 0}));
  EXPECT_FALSE(image_from_screen(map, {-2, 0}));
  // (2, 0) would come from the point (-2, 0), which is behind the horizon.
  EXPECT_FALSE(screen_from_image(map, {2, 0}));
}

TEST(Homography, RefusesWhatCannotBeInverted) {
  EXPECT_FALSE(validate(HomographyMap{glm::dmat3({1, 2, 3}, {2, 4, 6}, {0, 0, 1})}));
  EXPECT_FALSE(validate(HomographyMap{glm::dmat3(0.0)}));
  HomographyMap map;
  map.image_from_screen[1][2] = NAN;
  EXPECT_FALSE(validate(map));
}

TEST(Pinhole, AgreesWithAnIndependentBrownConrady) {
  std::mt19937 random(2);
  for (int i = 0; i < 5000; ++i) {
    const PinholeMap map = random_pinhole(random);
    const ScreenPoint s = random_screen_point(random);
    const auto p = image_from_screen(map, s);
    ASSERT_TRUE(p);
    const auto expected = reference_pinhole(map, s);
    EXPECT_NEAR(p->x, expected[0], 1e-9);  // 1e3 px times some 1e-13
    EXPECT_NEAR(p->y, expected[1], 1e-9);
  }
}

TEST(Pinhole, GoesThereAndBack) {
  std::mt19937 random(3);
  for (int i = 0; i < 5000; ++i) {
    const PinholeMap map = random_pinhole(random);
    const ScreenPoint s = random_screen_point(random);
    const auto p = image_from_screen(map, s);
    ASSERT_TRUE(p);
    const auto back = screen_from_image(map, *p);
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->x, s.x, 1e-12);  // 1e-15 of the solver times distance and a condition of some tens
    EXPECT_NEAR(back->y, s.y, 1e-12);
  }
}

TEST(Pinhole, UnturnedLooksStraightAtTheScreenWithVDown) {
  PinholeMap map;
  map.position = {0.1, 0.2, -2};
  map.focal_u_px = map.focal_v_px = 100;
  map.principal_u_px = 50;
  map.principal_v_px = 40;
  const auto p = image_from_screen(map, {0.1 + 0.2, 0.2 + 0.4});
  ASSERT_TRUE(p);
  EXPECT_NEAR(p->x, 60, 1e-12);
  EXPECT_NEAR(p->y, 20, 1e-12);
}

TEST(Pinhole, ATurnAboutXByPositiveAngleLooksDown) {
  // Right-handed about +x: the forward axis +z turns toward -y, so the screen's points rise in the image.
  PinholeMap map;
  map.position = {0, 0, -1};
  map.orientation = glm::angleAxis(0.1, glm::dvec3(1, 0, 0));
  const auto p = image_from_screen(map, {0, 0});
  ASSERT_TRUE(p);
  EXPECT_NEAR(p->x, 0, 1e-12);
  EXPECT_NEAR(p->y, -std::tan(0.1), 1e-12);
}

TEST(Pinhole, HasNoImageBehindTheProjector) {
  PinholeMap map;
  map.position = {0, 0, -1};
  map.orientation = glm::angleAxis(std::acos(-1.0), glm::dvec3(0, 1, 0));  // looks away
  EXPECT_FALSE(image_from_screen(map, {0, 0}));
  EXPECT_FALSE(screen_from_image(map, {0, 0}));
}

TEST(Pinhole, DistortionLimitIsWhereTheRadiusStopsGrowing) {
  PinholeMap map;
  EXPECT_EQ(distortion_limit(map), INFINITY);
  map.k1 = -0.1;  // 1 - 0.3 q = 0
  EXPECT_NEAR(distortion_limit(map), std::sqrt(1 / 0.3), 1e-12);
  map = {};
  map.k3 = -1.0 / 7;  // 1 - q^3 = 0
  EXPECT_NEAR(distortion_limit(map), 1, 1e-12);
  map = {};
  map.k1 = -2.0 / 3;  // 1 - 2 q + 0.75 q^2 = 0 at q = 2/3 and 2: the first counts
  map.k2 = 0.15;
  EXPECT_NEAR(distortion_limit(map), std::sqrt(2.0 / 3), 1e-12);
  map.k1 = -0.3;  // 1 - 0.9 q + 0.75 q^2 has no root
  EXPECT_EQ(distortion_limit(map), INFINITY);
}

TEST(Pinhole, HasNoImageBeyondTheFold) {
  PinholeMap map;
  map.position = {0, 0, -1};
  map.focal_u_px = map.focal_v_px = 100;
  map.k1 = -0.1;
  const double limit = distortion_limit(map);
  EXPECT_TRUE(image_from_screen(map, {0.999 * limit, 0}));
  EXPECT_FALSE(image_from_screen(map, {1.001 * limit, 0}));
  // The image ends where the fold lands; nothing within the limit reaches beyond.
  const double furthest_px = 100 * limit * (1 - 0.1 * limit * limit);
  EXPECT_TRUE(screen_from_image(map, {0.999 * furthest_px, 0}));
  EXPECT_FALSE(screen_from_image(map, {1.001 * furthest_px, 0}));
  EXPECT_FALSE(screen_from_image(map, {NAN, 0}));
  EXPECT_FALSE(screen_from_image(map, {INFINITY, 0}));
}

TEST(Pinhole, FoldedMapsNeverContradictThemselves) {
  // Strong distortions of every sign: wherever the inverse answers, the forward map agrees with it.
  std::mt19937 random(4);
  std::uniform_real_distribution<double> side(-1, 1);
  int answered = 0;
  for (int i = 0; i < 5000; ++i) {
    PinholeMap map;
    map.position = {0, 0, -1};
    map.focal_u_px = map.focal_v_px = 500;
    map.k1 = side(random);
    map.k2 = side(random);
    map.k3 = side(random);
    map.p1 = 0.1 * side(random);
    map.p2 = 0.1 * side(random);
    const PixelPoint p{800 * side(random), 800 * side(random)};
    const auto s = screen_from_image(map, p);
    if (!s) continue;
    ++answered;
    const auto back = image_from_screen(map, *s);
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->x, p.x, 1e-8);
    EXPECT_NEAR(back->y, p.y, 1e-8);
  }
  EXPECT_GT(answered, 1000);
}

TEST(Pinhole, RefusesNumbersThatMakeNoProjector) {
  const auto refused = [](auto change) {
    PinholeMap map;
    change(map);
    return validate(map) ? std::string() : validate(map).error().message();
  };
  EXPECT_EQ(refused([](PinholeMap&) {}), "");
  EXPECT_EQ(refused([](PinholeMap& m) { m.focal_u_px = 0; }).substr(0, 11), "focal_u_px:");
  EXPECT_EQ(refused([](PinholeMap& m) { m.focal_v_px = -1; }).substr(0, 11), "focal_v_px:");
  EXPECT_EQ(refused([](PinholeMap& m) { m.k2 = NAN; }).substr(0, 3), "k2:");
  EXPECT_EQ(refused([](PinholeMap& m) { m.position.y = INFINITY; }).substr(0, 9), "position:");
  PinholeMap four_digits;
  four_digits.orientation = {0.9239, 0.2209, 0.2209, 0.2209};  // its length is 1.00006
  EXPECT_TRUE(validate(four_digits));
  EXPECT_EQ(refused([](PinholeMap& m) { m.orientation.w = 1.0003; }).substr(0, 12), "orientation:");
  EXPECT_EQ(refused([](PinholeMap& m) { m.orientation.w = 2; }).substr(0, 12), "orientation:");
}

}  // namespace
}  // namespace lfd
