// The numbers of a check against displays whose answers are known, and which of them are refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "calibration/check/acceptance.h"
#include "calibration/check/derivatives.h"
#include "calibration/make.h"
#include "tests/unit/one_module.h"

namespace lfd {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// The ideal map of that display as a grid of so many cells, its nodes moved or taken away by `change`.
GridMap grid_of(
    int columns, int rows, const std::function<void(GridNodes&)>& change = [](GridNodes&) {}) {
  GridNodes nodes{columns + 1, rows + 1, 0, 0, 200.0 / columns, 100.0 / rows, {}};
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      nodes.node.push_back({2.0 * column / columns - 1, 0.5 - 1.0 * row / rows});
    }
  }
  change(nodes);
  auto map = GridMap::make(std::move(nodes));
  EXPECT_TRUE(map) << map.error().message();
  return *map;
}

ScreenPoint& node(GridNodes& nodes, int column, int row) {
  return nodes.node[static_cast<std::size_t>(row * nodes.columns + column)];
}

constexpr ScreenPoint kHole{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};

CalibrationReport checked(const ScreenMap& map) {
  DisplayCalibration display = one_module();
  display.modules[0].map = map;
  return check_calibration(display, 0.2);
}

// Rays of a pinhole that pass a narrow cylinder by light nothing, on the screen or beside it.
TEST(Check, RaysThatMissACurvedScreenAreUnmapped) {
  DisplayCalibration display = one_module();
  display.screen.width_m = 0.4;
  display.optics.screen_radius_m = 0.14;
  PinholeMap pinhole = pinhole_of_ideal(display.screen, display.image, {0, 0, -0.6});
  pinhole.focal_u_px = 200;  // 200 px wide: half of the image is 0.5 of the distance aside
  display.modules[0] = {{0, 0, -0.6}, pinhole};
  // The axis is 0.46 m away: tangent rays leave at asin(0.14 / 0.46), and u grows with the tangent.
  const double tangent = std::tan(std::asin(0.14 / (0.6 - 0.14)));
  const double unmapped = 1 - tangent * pinhole.focal_u_px / 100;
  const CheckSampling sampling;
  EXPECT_NEAR(check_calibration(display, 0.05).all.image_unmapped, unmapped, 2.0 / sampling.image_columns);
}

TEST(Check, TheIdealDisplayHasIdealNumbers) {
  const auto report = check_calibration(*make_display("640rc", 5), 0.2);
  EXPECT_LT(report.all.round_trip_max_px, 1e-9);
  EXPECT_EQ(report.all.image_on_screen, 1);
  EXPECT_EQ(report.all.image_unmapped, 0);
  EXPECT_EQ(report.all.mirrored, 0);
  EXPECT_EQ(report.all.near_singular, 0);
  EXPECT_EQ(report.all.coverage, 1);
  EXPECT_EQ(report.coverage_any, 1);
  EXPECT_THAT(report.lit_by, testing::Each(5));
  EXPECT_NEAR(report.pixel_width_m, 1.59 / 1024, 1e-9);  // by differences over a millionth of the screen
}

TEST(Check, AcceptsWhatTheToolMakes) {
  for (const std::string& name : display_names()) {
    const DisplayCalibration plain = *make_display(name, 3), off = perturbed(plain, 9);
    std::vector<DisplayCalibration> made{plain, off, *measured(off, 33, 25, 2, 1)};
    if (plain.optics.diffuser == Diffuser::kLinear) {
      // Bent more, the outermost modules of 722rc light too little of a convex screen, and have too much of their image
      // beside a concave one.
      for (const double widths : {-5.0, 10.0}) {
        made.push_back(*curved(off, widths * plain.screen.width_m, false));
        made.push_back(*measured(made.back(), 33, 25, 2, 1));
      }
    }
    for (const DisplayCalibration& display : made) {
      const auto report = check_calibration(display, default_half_depth_m(display), kQuickSampling);
      EXPECT_THAT(missed_limits(report, {}), IsEmpty()) << name << ", radius " << display.optics.screen_radius_m;
    }
    EXPECT_TRUE(accept_calibration(off)) << name;
  }
}

TEST(Check, FindsMirroredFlatAndMissingMaps) {
  EXPECT_EQ(checked(HomographyMap{glm::dmat3({-100, 0, 0}, {0, -100, 0}, {100, 50, 1})}).all.mirrored, 1);
  const auto flat = checked(HomographyMap{glm::dmat3({100, 0, 0}, {0, -1e6, 0}, {100, 50, 1})});
  EXPECT_EQ(flat.all.near_singular, 1);
  EXPECT_EQ(flat.all.mirrored, 0);
  EXPECT_GT(flat.all.condition_max, 1e3);
  // The image shows the middle half of the screen's width: half the image is lost, half the screen is dark.
  const auto narrow = checked(HomographyMap{glm::dmat3({200, 0, 0}, {0, -100, 0}, {100, 50, 1})});
  EXPECT_NEAR(narrow.modules[0].coverage, 0.5, 0.02);  // 65 columns of samples
  EXPECT_THAT(missed_limits(narrow, {}), ElementsAre(HasSubstr("coverage")));
  const auto wide = checked(HomographyMap{glm::dmat3({50, 0, 0}, {0, -100, 0}, {100, 50, 1})});
  EXPECT_NEAR(wide.all.image_on_screen, 0.5, 0.02);  // 48 columns of samples
  EXPECT_EQ(wide.all.image_unmapped, 0);
  EXPECT_EQ(wide.modules[0].coverage, 1);
  EXPECT_NEAR(wide.pixel_width_m, 0.02, 1e-9);
}

TEST(Check, NamesTheModuleThatIsWorst) {
  DisplayCalibration display = *make_display("desk", 6);
  display.modules[4].map = HomographyMap{glm::dmat3({-640, 0, 0}, {0, -640, 0}, {128, 96, 1})};
  const auto report = check_calibration(display, 0.05);
  EXPECT_EQ(report.worst_by(&MapNumbers::mirrored), 4);
  EXPECT_NEAR(report.all.mirrored, 1.0 / 6, 1e-12);
  EXPECT_THAT(missed_limits(report, {}), ElementsAre(HasSubstr("mirrored share of the image: 1 (module 4)")));
  const Status accepted = accept_calibration(display);
  ASSERT_FALSE(accepted);
  EXPECT_THAT(accepted.error().message(), HasSubstr("mirrored share of the image: 1 (module 4)"));
}

TEST(Check, ConditionOfTheLinearDisplayIsThatOfItsShear) {
  const DisplayCalibration display = one_module();
  const ModuleCalibration& module = display.modules[0];
  // Straight before the emitter at the observer's height nothing is sheared; 0.001 m below it hardly anything.
  EXPECT_NEAR(*condition_at(display, module, {0.2, 0.499, 0}), 1, 1e-7);
  for (const Point3<Physical> p : {Point3<Physical>{0.9, -0.4, 0}, Point3<Physical>{-0.7, 0.2, 0}}) {
    const double shear = std::pow((p.x - 0.2) / 2, 2) + std::pow((p.y - 0.5) / 4, 2);
    EXPECT_NEAR(*condition_at(display, module, p), (3 + shear) / 3, 1e-8);
  }
  const auto report = check_calibration(display, 1e-9);
  const double worst_corner = std::pow(1.2 / 2, 2) + std::pow(1.0 / 4, 2);
  EXPECT_LT(report.all.condition_max, (3 + worst_corner) / 3 + 1e-3);
  EXPECT_GT(report.all.condition_max, 1.05);
  EXPECT_LE(report.all.condition_median, report.all.condition_99);
  EXPECT_LE(report.all.condition_99, report.all.condition_max);
}

TEST(Check, ConditionIsTakenInTheRegionOfInterest) {
  const DisplayCalibration display = one_module();
  CheckSampling sampling = kQuickSampling;
  // A point at z = 0, but for a micrometre: the shear of the linear display alone.
  sampling.roi = PhysicalBox{{0.9, -0.4, 0}, glm::dvec3(1e-6)};
  const auto report = check_calibration(display, 0.2, sampling);
  const double shear = std::pow((0.9 - 0.2) / 2, 2) + std::pow((-0.4 - 0.5) / 4, 2);
  EXPECT_NEAR(report.all.condition_median, (3 + shear) / 3, 1e-5);
  EXPECT_NEAR(report.all.condition_max, report.all.condition_median, 1e-5);
  // 2 mm before the observers' line a step up moves the image by 2000 times as much.
  sampling.roi = PhysicalBox{{0.2, 0.4999, 3.998}, {0.01, 1e-5, 1e-4}};
  EXPECT_THAT(missed_limits(check_calibration(display, 0.2, sampling), {}), ElementsAre(HasSubstr("condition number")));
  // Behind the emitter nothing has an image.
  sampling.roi = PhysicalBox{{0, 0, -3}, glm::dvec3(1)};
  EXPECT_EQ(check_calibration(display, 0.2, sampling).all.condition_max, 0);
}

TEST(Check, AHoleOfKnownAreaIsMissingFromImageAndScreen) {
  // Without four nodes of a row 5 x 2 of 40 x 20 cells are missing.
  const auto report = checked(grid_of(40, 20, [](GridNodes& nodes) {
    for (int column = 10; column < 14; ++column) node(nodes, column, 10) = kHole;
  }));
  const double hole = 10.0 / 800;
  EXPECT_NEAR(report.modules[0].incomplete, hole, 1e-12);
  EXPECT_NEAR(report.modules[0].image_unmapped, hole, 0.005);  // 1728 samples of an area whose border is 5 % of it
  EXPECT_NEAR(report.modules[0].coverage, 1 - hole, 0.005);
  EXPECT_EQ(report.modules[0].folded, 0);
  EXPECT_THAT(missed_limits(report, {}), IsEmpty());
  AcceptanceLimits strict;
  strict.image_unmapped = 0.001;
  EXPECT_THAT(missed_limits(report, strict), ElementsAre(HasSubstr("without a map")));
}

TEST(Check, LimitsOfHolesCountCells) {
  // The upper 6 of 20 rows of cells are missing: more than a quarter of the grid and of the image.
  const auto report = checked(grid_of(40, 20, [](GridNodes& nodes) {
    for (int i = 0; i < 6 * 41; ++i) nodes.node[static_cast<std::size_t>(i)] = kHole;
  }));
  EXPECT_NEAR(report.modules[0].incomplete, 0.3, 1e-12);
  AcceptanceLimits limits;
  limits.coverage_least = 0;
  EXPECT_THAT(missed_limits(report, limits),
              ElementsAre(HasSubstr("without a map: 0.3056"),  // 11 of 36 rows of samples
                          HasSubstr("share of the grid in holes: 0.3 (module 0); at most 0.25 is accepted")));
  limits.image_unmapped = limits.incomplete = 0.31;
  EXPECT_THAT(missed_limits(report, limits), IsEmpty());
}

TEST(Check, AFoldedCornerIsRefused) {
  // The outermost node is drawn over its neighbours: the slopes at these turn back, so that the corner's cell and the
  // next ones along both borders fold.
  const GridMap folded = grid_of(16, 8, [](GridNodes& nodes) { node(nodes, 0, 0) = {-0.7, 0.2}; });
  const auto report = checked(folded);
  EXPECT_NEAR(report.modules[0].folded, 3.0 / 128, 1e-12);
  EXPECT_THAT(missed_limits(report, {}), testing::Contains(HasSubstr("folded share of the grid")));
  DisplayCalibration display = one_module();
  display.modules[0].map = folded;
  EXPECT_FALSE(accept_calibration(display));
  display.modules[0].map = grid_of(16, 8);
  EXPECT_TRUE(accept_calibration(display));
}

// The `desk` of `lfd-calibrate make desk --grid 33x25`, node (16, row) of its module 3 moved right by a share of a
// cell.
DisplayCalibration desk_with_moved_node(int row, double cells) {
  DisplayCalibration display = *measured(*make_display("desk"), 33, 25, 0, 1);
  GridMap& map = std::get<GridMap>(display.modules[3].map);
  GridNodes nodes = map.nodes();
  node(nodes, 16, row).x += cells * (nodes.at(17, row).x - nodes.at(16, row).x);
  map = *GridMap::make(nodes);
  return display;
}

// Folds that lie between the middles of cells and between the places that a quick check looks at.
TEST(Check, FoldsWithinCellsAreRefused) {
  for (const auto& [row, cells] : {std::pair{12, 0.9}, {10, 1.1}, {10, 1.2}}) {
    const DisplayCalibration display = desk_with_moved_node(row, cells);
    const auto report = check_calibration(display, 0.1, kQuickSampling);
    EXPECT_EQ(report.worst_by(&MapNumbers::folded), 3);
    EXPECT_LE(report.modules[3].folded, 12.0 / (32 * 24)) << "the cells that the node bends";
    EXPECT_THAT(missed_limits(report, {}), testing::Contains(HasSubstr("folded share of the grid")));
    const Status accepted = accept_calibration(display);
    ASSERT_FALSE(accepted);
    EXPECT_THAT(accepted.error().message(), HasSubstr("folded share of the grid"));
  }
  EXPECT_TRUE(accept_calibration(desk_with_moved_node(12, 0.3)));
}

TEST(Check, ExtremeDisplaysHaveFiniteAngles) {
  for (const double emitter_z : {-1e-6, -1e6}) {
    for (const ImageSize image : {ImageSize{1, 1}, ImageSize{8192, 8192}}) {
      DisplayCalibration display = one_module();
      display.image = image;
      display.angular_scattering_rad = 6;
      display.modules = {{{0.2, 0, emitter_z}, IdealMap{}}, {{0.3, 0, emitter_z}, IdealMap{}}};
      ASSERT_TRUE(validate(display));
      const auto report = check_calibration(display, default_half_depth_m(display), kQuickSampling);
      EXPECT_GE(report.all.condition_median, 1 - 1e-6);  // differences
      EXPECT_LT(report.all.round_trip_max_px, 1e-8);
      EXPECT_TRUE(std::isfinite(report.angles.from_centre->median_rad));
      EXPECT_GT(report.depth->doubled_at_m, 0);
    }
  }
}

TEST(Check, AGridThatMirrorsIsRefused) {
  const auto report = checked(grid_of(16, 8, [](GridNodes& nodes) {
    for (ScreenPoint& s : nodes.node) s.x = -s.x;
  }));
  EXPECT_EQ(report.all.mirrored, 1);
  EXPECT_EQ(report.all.folded, 0);  // against itself it has not
  EXPECT_THAT(missed_limits(report, {}), ElementsAre(HasSubstr("mirrored")));
}

}  // namespace
}  // namespace lfd
