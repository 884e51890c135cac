// Dense warps are thinned to the fewest nodes that lose no more than is allowed, and say what they lose.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "calibration/import/thin_warp.h"
#include "tests/support/unwrapped.h"

namespace lfd {
namespace {

using testing_support::unwrapped;

constexpr double kPixel_m = 0.002;  // of the image, on the screen

// 200 x 150 cells over 400 x 300 px: flat, but for a wave of this height along s and `waves` periods.
DenseWarp wavy(double height_px, double waves) {
  DenseWarp warp{200, 150, {400, 300}, {}};
  for (int row = 0; row < warp.height; ++row) {
    for (int column = 0; column < warp.width; ++column) {
      const double u = 2 * (column + 0.5), v = 2 * (row + 0.5);
      const double bump = height_px * std::sin(2 * std::numbers::pi * waves * u / 400);
      warp.points.push_back({kPixel_m * (u - 200 + bump), kPixel_m * (150 - v)});
    }
  }
  return warp;
}

double farthest_px(const DenseWarp& warp, const GridMap& map) {
  double worst = 0;
  for (int row = 0; row < warp.height; ++row) {
    for (int column = 0; column < warp.width; ++column) {
      const ScreenPoint& exact = warp.points[static_cast<std::size_t>(row * warp.width + column)];
      const auto got = screen_from_image(map, {2 * (column + 0.5), 2 * (row + 0.5)});
      if (got && !std::isnan(exact.x))
        worst = std::max(worst, std::hypot(got->x - exact.x, got->y - exact.y) / kPixel_m);
    }
  }
  return worst;
}

TEST(ThinWarp, TakesAsManyNodesAsTheToleranceNeeds) {
  const DenseWarp warp = wavy(2, 4);
  int columns = 0;
  for (const double tolerance : {1.0, 0.1, 0.01}) {
    const ThinnedWarp thin = unwrapped(thinned(warp, {tolerance, 257}));
    EXPECT_LE(thin.loss.max_px, tolerance);
    EXPECT_LE(thin.loss.median_px, thin.loss.max_px);
    EXPECT_EQ(thin.loss.holes_changed, 0);
    // Pixels are up to 1 + 2 pi 4 2 / 400 = 1.13 times as large on the screen as kPixel_m, or as much smaller.
    EXPECT_NEAR(thin.loss.max_px, farthest_px(warp, thin.map), 0.15 * thin.loss.max_px + 1e-12);
    EXPECT_GE(thin.map.nodes().columns, columns);
    columns = thin.map.nodes().columns;
  }
  EXPECT_GT(columns, 33);
}

TEST(ThinWarp, LosesNothingWhereTheWarpIsFlat) {
  const ThinnedWarp thin = unwrapped(thinned(wavy(0, 0), {1e-9, 257}));
  EXPECT_EQ(thin.map.nodes().columns, 33);
  EXPECT_LE(thin.loss.max_px, 1e-9);
}

TEST(ThinWarp, KeepsEveryCellWhereNothingLessWillDo) {
  DenseWarp warp = wavy(0, 0);
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0, 0.2 * kPixel_m);
  for (ScreenPoint& s : warp.points) s.x += noise(random);
  const ThinnedWarp whole = unwrapped(thinned(warp, {0.01, 257}));
  EXPECT_EQ(whole.map.nodes().columns, 200);
  EXPECT_EQ(whole.map.nodes().rows, 150);
  EXPECT_EQ(whole.loss.max_px, 0);
  EXPECT_EQ(farthest_px(warp, whole.map), 0);
  // Where so many are not allowed, it says what is lost: the noise itself.
  const ThinnedWarp rough = unwrapped(thinned(warp, {0.01, 65}));
  EXPECT_EQ(rough.map.nodes().columns, 65);
  EXPECT_GT(rough.loss.max_px, 0.5);
  EXPECT_NEAR(rough.loss.median_px, 0.2 * 0.67, 0.1);  // the median of |normal| is 0.67
}

TEST(ThinWarp, SaysHowManyCellsChangedToOrFromHoles) {
  DenseWarp warp = wavy(0, 0);
  int in_hole = 0;
  for (int row = 60; row < 90; ++row) {
    for (int column = 80; column < 120; ++column, ++in_hole)
      warp.points[static_cast<std::size_t>(row * warp.width + column)] = {std::nan(""), std::nan("")};
  }
  const ThinnedWarp thin = unwrapped(thinned(warp, {0.1, 257}));
  EXPECT_EQ(thin.map.nodes().columns, 33);
  // Cells between nodes are 6.2 x 4.7 of the warp's: the hole grows by up to one of them at each side.
  EXPECT_GT(thin.loss.holes_changed, 0);
  EXPECT_LE(thin.loss.holes_changed, ((40 + 2 * 6.3) * (30 + 2 * 4.7) - in_hole) / (200 * 150));
}

}  // namespace
}  // namespace lfd
