// Spaces as types: only transforms and points whose ends meet can be composed.
#include <gtest/gtest.h>

#include <concepts>
#include <numbers>
#include <random>

#include "calibration/spaces/pixel.h"
#include "calibration/spaces/roi.h"

namespace lfd {
namespace {

template <class A, class B>
concept CanMultiply = requires(A a, B b) {
  a* b;
};
template <class A, class B>
concept CanSubtract = requires(A a, B b) {
  a - b;
};
template <class A, class B>
concept CanAdd = requires(A a, B b) {
  a + b;
};

using PhysicalFromWorld = Affine<Physical, World>;
using WorldFromPhysical = Affine<World, Physical>;

static_assert(CanMultiply<PhysicalFromWorld, Point3<World>>);
static_assert(CanMultiply<PhysicalFromWorld, Vector3<World>>);
static_assert(!CanMultiply<PhysicalFromWorld, Point3<Physical>>);
static_assert(!CanMultiply<PhysicalFromWorld, Vector3<Physical>>);
static_assert(CanMultiply<PhysicalFromWorld, WorldFromPhysical>);
static_assert(!CanMultiply<PhysicalFromWorld, PhysicalFromWorld>);
static_assert(!CanSubtract<Point3<World>, Point3<Physical>>);
static_assert(!CanAdd<Point3<World>, Point3<World>>);
static_assert(!CanAdd<Point3<World>, Vector3<Physical>>);
static_assert(!std::convertible_to<ScreenPoint, PixelPoint>);
static_assert(std::same_as<decltype(PhysicalFromWorld{} * Point3<World>{}), Point3<Physical>>);
static_assert(std::same_as<decltype(PhysicalFromWorld{} * WorldFromPhysical{}), Affine<Physical, Physical>>);

RegionOfInterest random_roi(std::mt19937& random) {
  std::uniform_real_distribution<double> side(-1, 1), size(0.1, 10);
  RegionOfInterest roi;
  roi.world_centre = {100 * side(random), 100 * side(random), 100 * side(random)};
  roi.world_size = {size(random), size(random), size(random)};
  roi.world_orientation = glm::normalize(glm::dquat(side(random), side(random), side(random), side(random)));
  roi.physical_centre = {side(random), side(random), side(random)};
  roi.physical_size = {size(random), size(random), size(random)};
  return roi;
}

// A corner of the world box, by the meaning of orientation alone.
Point3<World> world_corner(const RegionOfInterest& roi, glm::dvec3 share) {
  return point_of<World>(to_glm(roi.world_centre) + roi.world_orientation * (share * roi.world_size));
}

// 1e-12: coordinates up to 100, some ten roundings.
constexpr double kRounding = 1e-12;

TEST(RegionOfInterest, TakesTheCornersOfTheWorldBoxToThoseOfThePhysicalOne) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const RegionOfInterest roi = random_roi(random);
    for (const glm::dvec3 share :
         {glm::dvec3(0.5, 0.5, 0.5), glm::dvec3(-0.5, 0.5, 0.5), glm::dvec3(0.5, -0.5, 0.5), glm::dvec3(0)}) {
      const glm::dvec3 expected = to_glm(roi.physical_centre) + share * roi.physical_size;
      const glm::dvec3 got = to_glm(physical_from_world(roi) * world_corner(roi, share));
      // The box is magnified by up to 100.
      EXPECT_LT(glm::length(got - expected), 100 * kRounding);
    }
  }
}

TEST(RegionOfInterest, MapsBackToWhereItCameFrom) {
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) {
    const RegionOfInterest roi = random_roi(random);
    const auto there_and_back = world_from_physical(roi) * physical_from_world(roi);
    EXPECT_LT(glm::length(there_and_back.offset), 100 * kRounding);
    for (int column = 0; column < 3; ++column) {
      EXPECT_LT(glm::length(there_and_back.linear[column] - glm::dmat3(1.0)[column]), kRounding);
    }
    const auto inverted = inverse(physical_from_world(roi));
    ASSERT_TRUE(inverted);
    const Point3<World> p = world_corner(roi, {0.1, -0.3, 0.4});
    EXPECT_LT(length(*inverted * (physical_from_world(roi) * p) - p), 100 * kRounding);
  }
}

TEST(RegionOfInterest, FitsTheSceneToTheScreenByOneScale) {
  const RegionOfInterest roi = fit_to_screen({0, 0, 0}, {4, 1, 2}, 1.6, 0.9);
  EXPECT_EQ(roi.world_centre, (Point3<World>{2, 0.5, 1}));
  EXPECT_EQ(roi.physical_centre, Point3<Physical>{});
  EXPECT_NEAR(roi.physical_size.x, 1.6, 1e-15);
  EXPECT_NEAR(roi.physical_size.y, 0.4, 1e-15);
  EXPECT_NEAR(roi.physical_size.z, 0.8, 1e-15);
  EXPECT_TRUE(validate(fit_to_screen({1, 1, 1}, {1, 1, 1}, 1, 1)));  // a point
  EXPECT_TRUE(validate(fit_to_screen({0, 0, 0}, {1, 0, 1}, 1, 1)));  // a floor
}

TEST(RegionOfInterest, RefusesBoxesThatHaveNoInside) {
  RegionOfInterest roi;
  EXPECT_TRUE(validate(roi));
  roi.world_size.y = 0;
  EXPECT_EQ(validate(roi).error().message().substr(0, 11), "world_size:");
  roi = {};
  roi.physical_size.z = NAN;
  EXPECT_FALSE(validate(roi));
  roi = {};
  roi.world_orientation = glm::dquat(1, 1, 0, 0);
  EXPECT_FALSE(validate(roi));
  roi = {};
  roi.physical_centre.x = INFINITY;
  EXPECT_FALSE(validate(roi));
  for (const double absurd : {1e300, 1e-300, 1e13, 1e-13}) {
    roi = {};
    roi.world_size.x = absurd;
    EXPECT_FALSE(validate(roi)) << absurd;
  }
  roi = {};
  roi.world_centre.z = -1e13;
  EXPECT_FALSE(validate(roi));
  roi.world_centre = {1e300, 0, 0};  // its square is infinite
  EXPECT_EQ(validate(roi).error().message().substr(0, 36), "world_centre: 1e+300 m from the orig");
  roi = {};
  roi.world_orientation = glm::dquat(0, 1e300, 0, 0);
  EXPECT_EQ(validate(roi).error().message().find("inf"), std::string::npos);
}

TEST(Affine, HasNoInverseWhereItFlattens) {
  Affine<Physical, World> flat;
  flat.linear[1] = glm::dvec3(0.0);
  EXPECT_FALSE(inverse(flat));
}

TEST(Pixel, TheFirstOneCoversZeroToOneAndItsCentreIsAHalf) {
  EXPECT_EQ(centre_of({0, 0}), (PixelPoint{0.5, 0.5}));
  EXPECT_EQ(pixel_at({0.999, 1.0}), (PixelIndex{0, 1}));
  EXPECT_TRUE(contains(ImageSize{4, 3}, PixelPoint{4, 3}));
  EXPECT_FALSE(contains(ImageSize{4, 3}, PixelPoint{4.001, 3}));
  EXPECT_FALSE(contains(ImageSize{4, 3}, PixelPoint{NAN, 1}));
}

}  // namespace
}  // namespace lfd
