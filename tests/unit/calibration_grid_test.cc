// Measured grids: interpolation, inversion, holes, folds, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <random>

#include "calibration/maps/bicubic_patch.h"
#include "calibration/maps/grid.h"

namespace lfd {
namespace {

using testing::HasSubstr;

constexpr double kHole = std::numeric_limits<double>::quiet_NaN();

using ScreenOf = std::function<ScreenPoint(PixelPoint)>;

// A grid over an image of 640 x 480 pixels, its nodes on the border.
GridNodes sampled(int columns, int rows, const ScreenOf& screen_of) {
  GridNodes nodes{columns, rows, 0, 0, 640.0 / (columns - 1), 480.0 / (rows - 1), {}};
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) nodes.node.push_back(screen_of(nodes.place(column, row)));
  }
  return nodes;
}

GridMap made(GridNodes nodes) {
  auto map = GridMap::make(std::move(nodes));
  EXPECT_TRUE(map) << map.error().message();
  return *map;
}

// The ideal map of a screen of 1.6 x 0.9 m.
ScreenPoint ideal(PixelPoint p) { return {(p.x / 640 - 0.5) * 1.6, (0.5 - p.y / 480) * 0.9}; }

// Keystone, a lens and a bump, as measured ones have: all smooth.
ScreenPoint warped(PixelPoint p) {
  const ScreenPoint s = ideal(p);
  const double w = 1 + 0.08 * s.x - 0.05 * s.y, r2 = s.x * s.x + s.y * s.y;
  return {s.x / w * (1 + 0.03 * r2) + 0.004 * std::sin(5 * s.y), s.y / w * (1 + 0.03 * r2) + 0.003 * std::sin(4 * s.x)};
}

std::vector<PixelPoint> random_pixels(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<PixelPoint> pixels;
  for (int i = 0; i < count; ++i) {
    const double u = 640 * unit(random), v = 480 * unit(random);
    pixels.push_back({u, v});
  }
  return pixels;
}

double apart_px(PixelPoint a, PixelPoint b) { return std::hypot(a.x - b.x, a.y - b.y); }

TEST(Grid, PassesThroughItsNodes) {
  const GridMap map = made(sampled(17, 13, warped));
  for (int row = 0; row < 13; ++row) {
    for (int column = 0; column < 17; ++column) {
      const auto s = screen_from_image(map, map.nodes().place(column, row));
      ASSERT_TRUE(s);
      // A sum of 16 products of numbers of up to 1 m.
      EXPECT_NEAR(s->x, map.nodes().at(column, row).x, 1e-15);
      EXPECT_NEAR(s->y, map.nodes().at(column, row).y, 1e-15);
    }
  }
}

TEST(Grid, KeepsAnIdealMapExactly) {
  const GridMap map = made(sampled(9, 7, ideal));
  for (const PixelPoint p : random_pixels(1000, 1)) {
    const auto s = screen_from_image(map, p);
    ASSERT_TRUE(s);
    // Catmull-Rom reproduces straight lines; what is left is rounding.
    EXPECT_NEAR(s->x, ideal(p).x, 1e-14);
    EXPECT_NEAR(s->y, ideal(p).y, 1e-14);
  }
}

// Twice the nodes, an eighth of the error: Catmull-Rom is of third order.
TEST(Grid, ApproachesASmoothMapInThirdOrder) {
  const auto worst = [](int columns, int rows) {
    const GridMap map = made(sampled(columns, rows, warped));
    double worst_m = 0;
    for (const PixelPoint p : random_pixels(2000, 2)) {
      if (p.x < 80 || p.x > 560 || p.y < 80 || p.y > 400) continue;  // border cells are of second order
      const auto s = screen_from_image(map, p);
      worst_m = std::max(worst_m, std::hypot(s->x - warped(p).x, s->y - warped(p).y));
    }
    return worst_m;
  };
  const double coarse = worst(17, 13), fine = worst(33, 25);
  EXPECT_LT(fine, coarse / 6) << "8 but for terms of higher order";
  EXPECT_LT(fine, 1e-5);
}

TEST(Grid, GoesThereAndBackToRounding) {
  const GridMap map = made(sampled(17, 13, warped));
  double worst = 0;
  for (PixelPoint p : random_pixels(20000, 3)) {
    // Borders and nodes too.
    if (p.x < 20) p.x = 0;
    if (p.y < 20) p.y = 480;
    if (p.x > 600) p.x = 640;
    const auto s = screen_from_image(map, p);
    ASSERT_TRUE(s) << p.x << " " << p.y;
    const auto back = image_from_screen(map, *s);
    ASSERT_TRUE(back) << p.x << " " << p.y;
    worst = std::max(worst, apart_px(*back, p));
  }
  // Screen points are rounded to 1e-16 m, a pixel is 2.5 mm: some 1e-13 px, times a few operations.
  EXPECT_LT(worst, 1e-11);
}

TEST(Grid, HasNoImageWhereNothingWasMeasured) {
  GridNodes nodes = sampled(17, 13, warped);
  nodes.node[6 * 17 + 8] = {kHole, kHole};  // at (320, 240): four cells are gone
  nodes.node[0] = {kHole, kHole};           // a corner
  const GridMap map = made(nodes);
  EXPECT_FALSE(screen_from_image(map, {321, 239}));
  EXPECT_FALSE(screen_from_image(map, {1, 1}));
  EXPECT_FALSE(image_from_screen(map, warped({321, 239})));
  EXPECT_FALSE(image_from_screen(map, warped({1, 1})));
  EXPECT_NEAR(map.complete_share(), 1 - 5.0 / (16 * 12), 1e-15);
  for (const PixelPoint p : {PixelPoint{-0.1, 100}, {640.1, 100}, {100, -0.1}, {100, 480.1}}) {
    EXPECT_FALSE(screen_from_image(map, p));
  }
  for (const ScreenPoint s : {ScreenPoint{5, 0}, {0, -5}, {kHole, 0}, {1e300, 1e300}}) {
    EXPECT_FALSE(image_from_screen(map, s));
  }
}

// The limit from both sides of every edge between cells, holes nearby or not, is the same.
TEST(Grid, IsContinuousAcrossItsCellsEvenBesideHoles) {
  GridNodes nodes = sampled(17, 13, warped);
  std::mt19937 random(4);
  for (int i = 0; i < 12; ++i) nodes.node[random() % nodes.node.size()] = {kHole, kHole};
  const GridMap map = made(nodes);
  int compared = 0;
  for (const PixelPoint& p : random_pixels(4000, 5)) {
    for (const bool vertical : {true, false}) {
      PixelPoint at = p;
      (vertical ? at.x : at.y) = 40 * std::round((vertical ? at.x : at.y) / 40);
      PixelPoint before = at, after = at;
      (vertical ? before.x : before.y) -= 1e-9;
      (vertical ? after.x : after.y) += 1e-9;
      const auto a = screen_from_image(map, before), b = screen_from_image(map, after);
      if (!a || !b) continue;
      ++compared;
      EXPECT_LT(std::hypot(a->x - b->x, a->y - b->y), 1e-10) << "2e-9 px are 5e-12 m";
    }
  }
  EXPECT_GT(compared, 3000);
}

// A sheet that turns back: x grows, then falls. Behind the fold there is no image, before it the inverse is right.
TEST(Grid, EndsWhereItFolds) {
  const ScreenOf folding = [](PixelPoint p) {
    const double t = p.x / 640;
    return ScreenPoint{t - 0.65 * t * t, 0.4 - p.y / 1200};  // turns at t = 1 / 1.3
  };
  const GridMap map = made(sampled(33, 25, folding));
  EXPECT_NEAR(map.folded_share(), 1 - 1 / 1.3, 0.04);
  int seen = 0;
  for (const PixelPoint p : random_pixels(5000, 6)) {
    const double t = p.x / 640;
    const auto s = screen_from_image(map, p);
    if (t > 1 / 1.3 + 0.02) {
      EXPECT_FALSE(s);
    } else if (t < 1 / 1.3 - 0.02) {
      ASSERT_TRUE(s);
      const auto back = image_from_screen(map, *s);
      ASSERT_TRUE(back);
      EXPECT_LT(apart_px(*back, p), 1e-7) << "the condition grows to 1e3 near the fold";
      ++seen;
    }
  }
  EXPECT_GT(seen, 3000);
  EXPECT_FALSE(image_from_screen(map, {0.45, 0.2})) << "beyond the fold line";
}

TEST(Grid, RefusesWhatIsNoGridAndNamesTheNode) {
  const auto refusal = [](const std::function<void(GridNodes&)>& spoil) {
    GridNodes nodes = sampled(5, 4, ideal);
    spoil(nodes);
    const auto map = GridMap::make(std::move(nodes));
    return map ? std::string() : map.error().message();
  };
  EXPECT_EQ(refusal([](GridNodes&) {}), "");
  EXPECT_THAT(refusal([](GridNodes& n) { n.rows = 1; }), HasSubstr("rows: 1; 2 to 4096"));
  EXPECT_THAT(refusal([](GridNodes& n) { n.columns = 5000; }), HasSubstr("columns: 5000"));
  EXPECT_THAT(refusal([](GridNodes& n) { n.node.pop_back(); }), HasSubstr("19 nodes; columns x rows are 20"));
  EXPECT_THAT(refusal([](GridNodes& n) { n.step_u_px = 0; }), HasSubstr("step_u_px: 0"));
  EXPECT_THAT(refusal([](GridNodes& n) { n.step_v_px = kHole; }), HasSubstr("step_v_px: nan"));
  EXPECT_THAT(refusal([](GridNodes& n) { n.first_u_px = INFINITY; }), HasSubstr("first_u_px"));
  EXPECT_THAT(refusal([](GridNodes& n) { n.node[7].x = 1e30; }), HasSubstr("s 7: column 2, row 1: 1e+30 m"));
  EXPECT_THAT(refusal([](GridNodes& n) { n.node[7].y = -INFINITY; }), HasSubstr("y 7: column 2, row 1: -inf m"));
  EXPECT_THAT(refusal([](GridNodes& n) { n.node[7].y = kHole; }),
              HasSubstr("y 7: column 2, row 1: is missing, the other coordinate"));
  EXPECT_THAT(refusal([](GridNodes& n) { n.node[8] = n.node[7]; }),
              HasSubstr("the same place of the screen as column 3"));
  EXPECT_THAT(refusal([](GridNodes& n) {
                std::fill(n.node.begin(), n.node.end(), ScreenPoint{kHole, kHole});
              }),
              HasSubstr("no cell"));
}

TEST(BicubicPatch, LiesInItsBoundsAndInItsHalvesBounds) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal(0, 1);
  for (int i = 0; i < 200; ++i) {
    std::array<glm::dvec2, 16> node;
    for (auto& n : node) n = {normal(random), normal(random)};
    const BicubicPatch patch = patch_between(node);
    const Box2 bounds = bounds_of(patch);
    for (double a = 0; a <= 1; a += 0.125) {
      for (double b = 0; b <= 1; b += 0.125) EXPECT_TRUE(bounds.contains(patch.at({a, b})));
    }
  }
}

// However wild a patch is, a point that it takes with the wanted orientation is found.
TEST(BicubicPatch, FindsEveryPointOfFoldedPatches) {
  std::mt19937 random(8);
  std::normal_distribution<double> normal(0, 0.6);
  int sought = 0;
  for (int i = 0; i < 300; ++i) {
    std::array<glm::dvec2, 16> node;
    for (int k = 0; k < 16; ++k) node[static_cast<std::size_t>(k)] = {k % 4 + normal(random), k / 4 + normal(random)};
    const BicubicPatch patch = patch_between(node);
    for (double a = 0.05; a < 1; a += 0.3) {
      for (double b = 0.05; b < 1; b += 0.3) {
        const double det = glm::determinant(patch.derivative({a, b}));
        if (std::abs(det) < 1e-3) continue;  // beside a fold line
        const glm::dvec2 target = patch.at({a, b});
        const auto found = invert(patch, target, det);
        ASSERT_TRUE(found) << "patch " << i;
        EXPECT_LT(glm::length(patch.at(*found) - target), 1e-12);
        ++sought;
      }
    }
  }
  EXPECT_GT(sought, 3000);
}

}  // namespace
}  // namespace lfd
