// Bent normals of march and gtao beside rays and an integral by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "base/log.h"
#include "tests/gl/ao_bent_pixels.h"

namespace lfd {
namespace {

using testing_support::AoStage;
using testing_support::bent_ao;
using testing_support::BentPixel;
using testing_support::draw_bent;
using testing_support::from_above;
using testing_support::made;

constexpr double kRadius = 0.12, kFloorY = -0.45, kWallZ = -0.45;

// What march estimates: the mean open direction of rays, by their cosine.
TEST(AoBentNormals, OfMarchAreThoseOfRays) {
  for (const std::string scene : {"wall", "corner"}) {
    AoStage stage(made(scene.c_str()), from_above(), reference::one_module(Diffuser::kLinear, {160, 120}));
    auto ao = bent_ao(*occlusion::find_method("march"), kRadius);
    ao.set_samples(64);
    (*ao.mutable_parameter())["steps"] = 32;
    auto pixels = draw_bent(stage, ao);
    // In the corner, or before the wall; there the floor ends at the left.
    const double left = scene == "wall" ? 0.5 * kRadius : 0;
    std::erase_if(pixels, [&](const BentPixel& pixel) {
      const double x = pixel.p.x + 0.8 - left, z = pixel.p.z - kWallZ;
      return std::abs(pixel.p.y - kFloorY) > 1e-4 || z > 0.8 * kRadius || x < 0 || x > 1.5 * kRadius;
    });
    ASSERT_GT(pixels.size(), 60U);
    double worst = 0, sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < pixels.size(); i += pixels.size() / 40) {
      const auto rays = stage.rays(pixels[i].at, kRadius, {1024, i});
      ASSERT_TRUE(rays);
      const double off = glm::distance(rays->open_cosine, pixels[i].bent);
      worst = std::max(worst, off);
      sum += off;
      ++count;
    }
    fmt::print("{}: march is {:.4f} off the rays on average, {:.4f} at worst\n", scene, sum / count, worst);
    // Rays: 3 x 0.25 / sqrt(1024) = 0.023 in each axis if nothing stratified them; the wall is met up to half a pixel
    // (0.04 R) off.
    EXPECT_LT(sum / count, 0.02) << scene;
    EXPECT_LT(worst, 0.08) << scene;
  }
}

// By hand: a floor and a wall at distance d that everything behind is hidden by, seen from where `viewers` points.
// Directions lie in slices through the viewers' line; in each the horizon is the part of the wall within the radius
// that is nearest to it.
struct ByHand {
  glm::dvec3 bent{0};
  double hidden = 0;
};

ByHand horizons_by_hand(double d, glm::dvec3 viewers, double falloff) {
  constexpr int kRows = 60, kColumns = 120, kAngles = 200;
  const glm::dvec3 n(0, 1, 0);
  ByHand sum{n, 0};
  for (int i = 0; i < kRows * kColumns; ++i) {
    const double height2 = (i / kColumns + 0.5) / kRows, r = std::sqrt(1 - height2);  // as likely as their cosine
    const double turn = 2 * std::numbers::pi * (i % kColumns + 0.5) / kColumns;
    const glm::dvec3 w(r * std::cos(turn), std::sqrt(height2), r * std::sin(turn));
    const glm::dvec3 across = glm::normalize(w - glm::dot(w, viewers) * viewers);
    const double x = glm::dot(n, across), y = glm::dot(n, viewers), tangent = std::cos(std::atan2(x, y) + M_PI / 2);
    double highest = tangent;
    for (int k = 0; k < kAngles; ++k) {
      const double angle = std::numbers::pi * (k + 0.5) / kAngles;
      const glm::dvec3 along = std::cos(angle) * viewers + std::sin(angle) * across;
      const double way = along.z < 0 ? -d / along.z : 2 * kRadius;
      if (way > kRadius || along.y < 0) continue;
      const double weight = falloff > 0 ? std::clamp((1 - way / kRadius) / falloff, 0.0, 1.0) : 1;
      highest = std::max(highest, tangent + weight * (std::cos(angle) - tangent));
    }
    if (glm::dot(w, viewers) >= highest) continue;
    sum.hidden += 1.0 / (kRows * kColumns);
    sum.bent -= 1.5 / (kRows * kColumns) * w;  // all of them add up to 2/3 of the normal
  }
  return sum;
}

// Along the line of the pixel that shows a point; unit, in the world.
glm::dvec3 to_viewers(const DisplayCalibration& display, glm::dvec3 p) {
  const Affine<World, Physical> to_world = world_from_physical(from_above());
  const Point3<Physical> physical = physical_from_world(from_above()) * point_of<World>(p);
  const auto shown = on_screen(display.optics, display.modules[0].emitter, physical);
  const auto line = line_of_screen_point(display.optics, display.modules[0].emitter, shown->at);
  return glm::normalize(to_glm(to_world * line->on_observer_line - to_world * line->on_screen));
}

TEST(AoBentNormals, OfGtaoBesideAWallAreTheIntegralOverItsSlices) {
  const DisplayCalibration display = reference::one_module(Diffuser::kLinear, {256, 192});
  AoStage stage(made("wall"), from_above(), display);
  for (const bool bitmask : {false, true}) {
    auto ao = bent_ao(*occlusion::find_method("gtao"), kRadius);
    (*ao.mutable_parameter())["slices"] = 32;
    (*ao.mutable_parameter())["steps"] = 64;
    (*ao.mutable_parameter())["bitmask"] = bitmask ? 1 : 0;
    (*ao.mutable_parameter())["thickness"] = 1000;
    const auto pixels = draw_bent(stage, ao);
    for (const double share : {0.2, 0.4, 0.5}) {
      glm::dvec3 drawn(0), expected(0);
      double hidden = 0;
      int count = 0;
      for (const BentPixel& pixel : pixels) {
        const double d = pixel.p.z - kWallZ;
        if (std::abs(pixel.p.y - kFloorY) > 1e-4 || std::abs(pixel.p.x + 0.4) > 0.1) continue;
        if (std::abs(d / kRadius - share) > 0.03) continue;
        if (count++ % 8 != 0) continue;
        const auto line = to_viewers(display, pixel.p);
        const ByHand by_hand = horizons_by_hand(d, line, bitmask ? 0 : 0.6);
        drawn += pixel.bent;
        expected += by_hand.bent;
        hidden += by_hand.hidden;
      }
      ASSERT_GT(count, 40);
      const double used = (count + 7) / 8;
      fmt::print("gtao{} at {} R: ({:.3f} {:.3f} {:.3f}), by hand ({:.3f} {:.3f} {:.3f}), {:.3f} hidden\n",
                 bitmask ? ", bitmask" : "", share, drawn.x / used, drawn.y / used, drawn.z / used, expected.x / used,
                 expected.y / used, expected.z / used, hidden / used);
      EXPECT_LT(glm::distance(drawn, expected) / used, 0.03) << share;
      EXPECT_GT(hidden / used, 0.02);
    }
  }
}

}  // namespace
}  // namespace lfd
