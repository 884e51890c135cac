// Tables of measured maps: within the stated error, continued beside what was measured, finer where the map bends more.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "calibration/make.h"
#include "rendernode/geometry/clip_map.h"
#include "rendernode/geometry/warp_table.h"
#include "tests/support/made.h"

namespace lfd {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing_support::unwrapped;

DisplayCalibration measured_desk(double bump_px, int columns = 33, int rows = 25) {
  return unwrapped(measured(perturbed(unwrapped(make_display("desk")), 7), columns, rows, bump_px, 1));
}

// Whether the map has a pixel everywhere within a cell of the table around a point: no corner near it was continued.
bool is_amid(const DisplayCalibration& display, std::uint32_t module, const WarpTable& table, ScreenPoint s) {
  for (const double i : {-1, 0, 1}) {
    for (const double j : {-1, 0, 1}) {
      const auto& grid = std::get<GridMap>(display.modules[module].map);
      if (!image_from_screen(grid, {s.x + i * table.cell.x, s.y + j * table.cell.y})) return false;
    }
  }
  return true;
}

// Largest distance of the table from the map at random points that have a pixel, in pixels; `amid`: away from the
// border of what was measured only.
double worst_px(const DisplayCalibration& display, std::uint32_t module, const WarpTable& table, bool amid = false) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(-0.5, 0.5);
  double worst = 0;
  for (int i = 0; i < 4000; ++i) {
    const double x = unit(random) * display.screen.width_m, y = unit(random) * display.screen.height_m;
    const auto exact = image_from_screen(display, display.modules[module], {x, y});
    if (!exact || (amid && !is_amid(display, module, table, {x, y}))) continue;
    const auto p = table.at({x, y});
    EXPECT_TRUE(p);
    if (p) worst = std::max(worst, glm::length(*p - glm::dvec2(exact->x, exact->y)));
  }
  return worst;
}

TEST(WarpTable, IsWithinItsToleranceAndSaysHowFarItIs) {
  const DisplayCalibration display = measured_desk(3);
  const WarpTables tables = warp_tables(display, {0, 3, 7});
  ASSERT_EQ(tables.of_module.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t module = std::array<std::uint32_t, 3>{0, 3, 7}[i];
    ASSERT_TRUE(tables.of_module[i]);
    EXPECT_LE(tables.of_module[i]->error_px, kTableTolerance_px);
    // The error is measured where bilinear interpolation is worst to second order; elsewhere it may be a little larger:
    // the curvature of a grid's map jumps at its nodes.
    EXPECT_LE(worst_px(display, module, *tables.of_module[i], true), 1.25 * kTableTolerance_px);
    // Cells at the border of what was measured, continued in straight lines, may be off by their own second order.
    EXPECT_LE(worst_px(display, module, *tables.of_module[i]), 4 * kTableTolerance_px);
  }
}

// Bilinear: half the distance between nodes, a quarter of the error.
TEST(WarpTable, ErrsInSecondOrder) {
  const DisplayCalibration display = measured_desk(3);
  const double coarse = warp_table(display, display.modules[3], 5).error_px;
  const double fine = warp_table(display, display.modules[3], 6).error_px;
  EXPECT_NEAR(coarse / fine, 4, 1);
}

TEST(WarpTable, IsFinerWhereTheMapBendsMore) {
  EXPECT_LT(warp_tables(measured_desk(0.02), {3}).level, warp_tables(measured_desk(6), {3}).level);
}

TEST(WarpTable, OfATakenLevelIsOfThatLevel) {
  const WarpTables tables = warp_tables(measured_desk(3), {3}, 4);
  EXPECT_EQ(tables.level, 4);
  EXPECT_EQ(tables.of_module[0]->columns, 17);
}

TEST(WarpTable, OtherMapsHaveNone) {
  const WarpTables tables = warp_tables(unwrapped(make_display("desk")), {0, 1});
  EXPECT_FALSE(tables.of_module[0]);
  EXPECT_FALSE(tables.of_module[1]);
}

// Corners of triangles need a place beside the image, in holes and far off; every place is a number.
TEST(WarpTable, GoesOnBesideWhatWasMeasured) {
  DisplayCalibration display = measured_desk(2, 17, 13);
  GridNodes nodes = std::get<GridMap>(display.modules[3].map).nodes();
  const double hole = std::numeric_limits<double>::quiet_NaN();
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 6; ++column) nodes.node[static_cast<std::size_t>(row * 17 + column)] = {hole, hole};
  }
  display.modules[3].map = unwrapped(GridMap::make(nodes));
  const WarpTable table = warp_table(display, display.modules[3], 5);
  for (double x = -3; x <= 3; x += 0.05) {
    for (double y = -3; y <= 3; y += 0.05) {
      const auto p = table.at({x, y});
      if (!p) continue;  // behind the base's horizon
      EXPECT_TRUE(std::isfinite(p->x) && std::isfinite(p->y)) << x << " " << y;
    }
  }
  // In the hole it is near the map that was measured around it: within the bump, 2 px, and its slope over 6 cells.
  const DisplayCalibration whole = measured_desk(2, 17, 13);
  const auto truly = image_from_screen(whole, whole.modules[3], {-0.15, 0.11});
  ASSERT_TRUE(truly);
  const auto p = table.at({-0.15, 0.11});
  ASSERT_TRUE(p);
  EXPECT_LT(glm::length(*p - glm::dvec2(truly->x, truly->y)), 8);
}

// A node of a display that lights nothing of the screen still gets a table: that of its base alone.
TEST(WarpTable, OfAModuleBesideTheScreenIsItsBase) {
  DisplayCalibration display = unwrapped(make_display("desk"));
  GridNodes nodes{3, 3, 0, 0, 100, 90, {}};
  for (int i = 0; i < 9; ++i) nodes.node.push_back({5 + 0.1 * (i % 3), 5 - 0.1 * (i / 3)});
  display.modules[0].map = unwrapped(GridMap::make(nodes));
  const WarpTable table = warp_table(display, display.modules[0], 4);
  EXPECT_EQ(table.residual_px.front(), glm::vec2(0));
}

// The desk's module 3 as measured with 129 x 97 nodes, of which every other is off by this much along s.
DisplayCalibration rough_desk(double off_px) {
  DisplayCalibration display = measured_desk(0, 129, 97);
  GridNodes nodes = std::get<GridMap>(display.modules[3].map).nodes();
  const double pixel_m = display.screen.width_m / display.image.width;
  for (std::size_t i = 0; i < nodes.node.size(); i += 2) nodes.node[i].x += off_px * pixel_m;
  display.modules[3].map = unwrapped(GridMap::make(std::move(nodes)));
  return display;
}

// Two bends of a few hundredths of a pixel in each of the grid's cells, which are four table cells wide at most.
TEST(WarpTable, WarnsWhereTheFinestMissesTheTolerance) {
  const DisplayCalibration display = rough_desk(0.3);
  const WarpTables tables = warp_tables(display, {0, 3});
  EXPECT_EQ(tables.columns(), 513);
  const auto warnings = warnings_of(tables, {0, 3});
  ASSERT_TRUE(warnings) << warnings.error().message();
  EXPECT_THAT(*warnings, ElementsAre(AllOf(HasSubstr("module 3"), HasSubstr("513 columns"))));
  // It says how far off it is: no point found at random is further off than twice that.
  EXPECT_GT(tables.of_module[1]->error_px, kTableTolerance_px);
  EXPECT_LE(worst_px(display, 3, *tables.of_module[1]), 2 * tables.of_module[1]->error_px);
}

TEST(WarpTable, IsRefusedWhereTheMapBendsTooSharply) {
  const auto warnings = warnings_of(warp_tables(rough_desk(2), {3}), {3});
  ASSERT_FALSE(warnings);
  EXPECT_THAT(warnings.error().message(), AllOf(HasSubstr("module 3"), HasSubstr("at most 0.1 px")));
}

TEST(WarpTable, OfASmoothMapHasNothingToWarnOf) {
  EXPECT_THAT(unwrapped(warnings_of(warp_tables(measured_desk(3), {0, 3}), {0, 3})), IsEmpty());
}

// Cells beside a hole are continued, and counted apart.
TEST(WarpTable, SaysHowFarItIsBesideHoles) {
  DisplayCalibration display = measured_desk(3);
  const double whole = warp_table(display, display.modules[3], 6).border_error_px;  // at the image's own border
  GridNodes nodes = std::get<GridMap>(display.modules[3].map).nodes();
  nodes.node[12 * 33 + 16] = {std::nan(""), std::nan("")};
  display.modules[3].map = unwrapped(GridMap::make(std::move(nodes)));
  const WarpTable table = warp_table(display, display.modules[3], 6);
  EXPECT_GT(table.border_error_px, whole);
  EXPECT_LT(table.border_error_px, 1);  // straight on over at most a cell of a map that bends by 3 px in eight
  EXPECT_LE(worst_px(display, 3, table), 2 * std::max(table.border_error_px, table.error_px));
}

}  // namespace
}  // namespace lfd
