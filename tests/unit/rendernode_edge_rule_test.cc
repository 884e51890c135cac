// The rule for edges and the drawn map, on random displays of every kind.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "rendernode/geometry/edge_rule.h"
#include "rendernode/plan/frame_plan.h"
#include "tests/unit/rendernode_displays.h"

namespace lfd {
namespace {

using testing_support::kDiffusers;
using testing_support::kMapKinds;
using testing_support::Random;
using testing_support::random_display;
using testing_support::uniform;

Point3<Physical> random_point(Random& random, const DisplayCalibration& display, double z_low, double z_high) {
  const double w = display.screen.width_m, h = display.screen.height_m;
  return {uniform(random, -w, w), uniform(random, -h, h), uniform(random, z_low, z_high)};
}

template <class Visit>
void for_random_displays(Visit visit) {
  Random random(1);
  for (const auto diffuser : kDiffusers) {
    for (const auto kind : kMapKinds) {
      for (int i = 0; i < 3; ++i) visit(random_display(diffuser, kind, random), random);
    }
  }
}

TEST(RendernodeClipMap, IsTheCalibratedMapWhereThatHasAnImage) {
  int with_image = 0;
  for_random_displays([&](const DisplayCalibration& display, Random& random) {
    for (int i = 0; i < 2000; ++i) {
      const auto& module = display.modules[static_cast<std::size_t>(i % 3)];
      const auto p = random_point(random, display, -2, 2);
      const auto image = image_from_physical(display, module, p);
      if (!image) continue;
      ++with_image;
      const auto clip = ClipMap(display, module, nullptr).clip_from_physical(p);
      ASSERT_TRUE(clip);
      // Both are double precision in other orders of operations: pixels are of the order 1e3, so 1e-9 is 1e4 roundings.
      EXPECT_NEAR(clip->x / clip->z, image->u, 1e-9);
      EXPECT_NEAR(clip->y / clip->z, image->v, 1e-9);
    }
  });
  EXPECT_GT(with_image, 5000);
}

// Slack: the quick refusal of short edges goes by a bend that is sampled with a margin, not proven.
TEST(RendernodeEdgeRule, EdgesThatStayWholeDeviateByAToleranceAtMost) {
  int whole = 0, split = 0;
  for_random_displays([&](const DisplayCalibration& display, Random& random) {
    const DepthLimits limits = depth_limits(display, {});
    const WarpTables tables = warp_tables(display, {0, 1, 2});
    const EdgeRule rule(display, {0, 1, 2}, tables, limits, 0.02);
    for (int i = 0; i < 2000; ++i) {
      const auto a = random_point(random, display, limits.back, limits.front);
      const double reach = std::exp(uniform(random, std::log(1e-3), std::log(1.0)));
      auto b = a + reach * (random_point(random, display, -1, 1) - Point3<Physical>{});
      b.z = std::clamp(b.z, limits.back, limits.front);
      const bool must = rule.must_split(a, b);
      EXPECT_EQ(must, rule.must_split(b, a));
      (must ? split : whole) += 1;
      if (must) continue;
      EXPECT_LE(rule.deviation(a, b), 1 + 1e-6)
          << a.x << " " << a.y << " " << a.z << ", " << b.x << " " << b.y << " " << b.z;
    }
  });
  EXPECT_GT(whole, 2000);
  EXPECT_GT(split, 2000);
}

// Where the map is linear along an edge there is nothing to split: edges in the plane of the screen, by an ideal map.
TEST(RendernodeEdgeRule, LeavesTheScreensPlaneWhole) {
  Random random(2);
  for (const auto diffuser : kDiffusers) {
    const auto display = random_display(diffuser, testing_support::MapKind::kIdeal, random);
    const WarpTables tables = warp_tables(display, {0, 1, 2});
    const EdgeRule rule(display, {0, 1, 2}, tables, depth_limits(display, {}), 0.02);
    for (int i = 0; i < 200; ++i)
      EXPECT_FALSE(rule.must_split(random_point(random, display, 0, 0), random_point(random, display, 0, 0)));
  }
}

TEST(RendernodeVisibility, IsNeverDeniedToABoxWithAPointThatHasAnImage) {
  int denied = 0;
  for_random_displays([&](const DisplayCalibration& display, Random& random) {
    for (int box = 0; box < 60; ++box) {
      const auto& module = display.modules[static_cast<std::size_t>(box % 3)];
      const auto centre = random_point(random, display, -2.5, 4);
      const glm::dvec3 half(uniform(random, 0, 0.5), uniform(random, 0, 0.5), uniform(random, 0, 0.5));
      const auto low = point_of<Physical>(to_glm(centre) - half), high = point_of<Physical>(to_glm(centre) + half);
      if (may_be_seen(display, module, low, high)) continue;
      ++denied;
      for (int i = 0; i < 10000; ++i) {
        const Point3<Physical> p{uniform(random, low.x, high.x), uniform(random, low.y, high.y),
                                 uniform(random, low.z, high.z)};
        ASSERT_FALSE(image_from_physical(display, module, p)) << p.x << " " << p.y << " " << p.z;
      }
    }
  });
  EXPECT_GT(denied, 100);
}

}  // namespace
}  // namespace lfd
