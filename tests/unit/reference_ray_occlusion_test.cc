// Ambient occlusion by rays: known answers for open planes, wells, walls, and what a radius changes.
#include "bench/reference/ray_occlusion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "bench/reference/scene_maker.h"

namespace lfd::reference {
namespace {

constexpr RayChoice kRays{4096, 3};
// Two standard errors of as many rays that nothing stratifies: 2 x 0.5 / 64. Strata only stay further below.
constexpr double kTolerance = 0.016;

std::vector<RayOcclusion> at(const SceneMaker& maker, Point3<World> p, Vector3<World> n, std::vector<double> radii,
                             const RegionOfInterest& roi = same_spaces()) {
  const WorldScene scene = scene_of(maker, roi);
  const Intersector intersector(scene);
  return ray_occlusion(intersector, {p, n}, radii, kRays);
}

SceneMaker floor_of(float half) {
  SceneMaker maker;
  maker.add_quad({-half, 0, half}, {half, 0, half}, {half, 0, -half}, {-half, 0, -half},
                 maker.add_material({.double_sided = true}));
  return maker;
}

TEST(RayOcclusion, OfAnOpenPlaneIsNone) {
  for (const auto& found : at(floor_of(10), {0.1, 0, 0.2}, {0, 1, 0}, {1e-3, 1, 1e3})) {
    EXPECT_EQ(found.cosine, 0);
    EXPECT_EQ(found.uniform, 0);
    EXPECT_EQ(found.open_cosine, glm::dvec3(0, 1, 0));
    EXPECT_EQ(found.open_uniform, glm::dvec3(0, 1, 0));
  }
}

// All round the horizon stands at h: sin^2 h is hidden where light is weighed by its cosine, sin h where it is not.
TEST(RayOcclusion, AtTheBottomOfAWellIsTheHorizonsSine) {
  constexpr int kSides = 128;
  for (const double h : {0.2, 0.7, 1.2}) {
    SceneMaker maker = floor_of(10);
    const auto wall = maker.add_material({.double_sided = true});
    const auto top = static_cast<float>(std::tan(h));
    for (int i = 0; i < kSides; ++i) {
      const auto corner = [&](int k) {
        const double turn = 2 * std::numbers::pi * k / kSides;
        return glm::vec2(std::cos(turn), std::sin(turn));
      };
      const glm::vec2 a = corner(i), b = corner(i + 1);
      maker.add_quad({a.x, 0, a.y}, {b.x, 0, b.y}, {b.x, top, b.y}, {a.x, top, a.y}, wall);
    }
    const auto found = at(maker, {0, 0, 0}, {0, 1, 0}, {1e6});
    EXPECT_NEAR(found[0].cosine, std::pow(std::sin(h), 2), kTolerance) << h;
    EXPECT_NEAR(found[0].uniform, std::sin(h), kTolerance) << h;
    // Of sin e: the integrals of 3 sin^2 e cos e and 2 sin e cos e above h.
    EXPECT_LT(glm::distance(found[0].open_cosine, {0, 1 - std::pow(std::sin(h), 3), 0}), 2 * kTolerance) << h;
    EXPECT_LT(glm::distance(found[0].open_uniform, {0, 1 - std::pow(std::sin(h), 2), 0}), 2 * kTolerance) << h;
  }
}

// Directions (theta from the floor's normal, phi) meet a wall at distance d after d / (sin theta cos phi).
RayOcclusion before_wall(double d, double radius) {
  constexpr int kSteps = 800;
  RayOcclusion sum{0, 0, {0, 1, 0}, {0, 1, 0}};
  for (int i = 0; i < kSteps; ++i) {
    const double height = (i + 0.5) / kSteps, r = std::sqrt(1 - height * height);
    for (int j = 0; j < kSteps; ++j) {
      const double toward = r * std::cos(std::numbers::pi * ((j + 0.5) / kSteps - 0.5));
      const double weight = std::max(0.0, 1 - d / toward / radius) / (2.0 * kSteps * kSteps);  // half of all turns
      sum.uniform += weight;
      sum.cosine += 2 * height * weight;
      // What it hides of the directions: those to both sides along the wall cancel out, and it stands where z is less.
      const glm::dvec3 direction(0, height, -toward);
      sum.open_uniform -= 2 * weight * direction;
      sum.open_cosine -= 3 * height * weight * direction;
    }
  }
  return sum;
}

TEST(RayOcclusion, BeforeAWallFallsWithDistanceAndGrowsWithTheRadius) {
  SceneMaker maker = floor_of(100);
  maker.add_quad({-100, 0, 0}, {100, 0, 0}, {100, 100, 0}, {-100, 100, 0}, maker.add_material({.double_sided = true}));
  for (const double d : {0.02, 0.1, 0.5}) {
    const std::vector<double> radii{0.25, 1, 4};
    const auto found = at(maker, {0, 0, d}, {0, 1, 0}, radii);
    for (std::size_t k = 0; k < radii.size(); ++k) {
      const RayOcclusion expected = before_wall(d, radii[k]);
      EXPECT_NEAR(found[k].cosine, expected.cosine, kTolerance) << d << ", " << radii[k];
      EXPECT_NEAR(found[k].uniform, expected.uniform, kTolerance) << d << ", " << radii[k];
      EXPECT_LT(glm::distance(found[k].open_cosine, expected.open_cosine), 2 * kTolerance) << d << ", " << radii[k];
      EXPECT_LT(glm::distance(found[k].open_uniform, expected.open_uniform), 2 * kTolerance) << d << ", " << radii[k];
    }
  }
}

// Distances are the world's, whatever the region of interest makes of it in physical space.
TEST(RayOcclusion, IsMeasuredInTheWorld) {
  SceneMaker maker = floor_of(10);
  maker.add_quad({-10, 0, 0}, {10, 0, 0}, {10, 10, 0}, {-10, 10, 0}, maker.add_material({.double_sided = true}));
  RegionOfInterest stretched;
  stretched.world_centre = {0.3, 0.2, 0.1};
  stretched.world_size = {1, 2, 0.5};
  stretched.physical_size = {0.3, 0.1, 0.4};
  const auto plain = at(maker, {0, 0, 0.1}, {0, 1, 0}, {1}), other = at(maker, {0, 0, 0.1}, {0, 1, 0}, {1}, stretched);
  EXPECT_NEAR(plain[0].cosine, other[0].cosine, 1e-9);
  EXPECT_NEAR(plain[0].uniform, other[0].uniform, 1e-9);
}

}  // namespace
}  // namespace lfd::reference
