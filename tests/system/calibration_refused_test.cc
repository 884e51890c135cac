// A calibration that fails its check does not drive a display, unless it is accepted all the same.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "base/log.h"
#include "calibration/make.h"
#include "proto/calibration_file.h"
#include "tests/harness/workbench.h"

namespace lfd::harness {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

constexpr auto kPatience = 20s;

DisplayCalibration small_display() {
  DisplayCalibration display;
  display.name = "small";
  display.screen = {1.6, 0.9};
  display.image = {16, 8};
  display.optics = {Diffuser::kLinear, 0, 2};
  display.angular_scattering_rad = 0.4;
  for (int k = 0; k < 4; ++k) display.modules.push_back({Emitter{-0.6 + 0.4 * k, 0, -1}, IdealMap{}});
  return display;
}

// Left and right are swapped in module 2.
DisplayCalibration mirrored_display() {
  DisplayCalibration display = small_display();
  display.modules[2].map = HomographyMap{glm::dmat3({-10, 0, 0}, {0, -8 / 0.9, 0}, {8, 4, 1})};
  return display;
}

// A corner of module 1's grid lies over its neighbours.
DisplayCalibration folded_display() {
  DisplayCalibration display = small_display();
  GridNodes nodes{9, 9, 0, 0, 2, 1, {}};
  for (int row = 0; row < 9; ++row) {
    for (int column = 0; column < 9; ++column) nodes.node.push_back({0.2 * (column - 4), 0.9 / 8 * (4 - row)});
  }
  nodes.node[0] = {-0.5, 0.2};
  display.modules[1].map = *GridMap::make(nodes);
  return display;
}

// Measured; in module 3 a node lies 0.9 of a cell beside its place: the map folds between the middles of its cells.
DisplayCalibration display_folded_within_cells() {
  DisplayCalibration display = *measured(*make_display("desk"), 33, 25, 0, 1);
  GridMap& map = std::get<GridMap>(display.modules[3].map);
  GridNodes nodes = map.nodes();
  nodes.node[12 * 33 + 16].x += 0.9 * (nodes.at(17, 12).x - nodes.at(16, 12).x);
  map = *GridMap::make(nodes);
  return display;
}

void save(const Workbench& bench, const DisplayCalibration& display) {
  const Status saved = save_calibration(bench.folder() / "display.textproto", display);
  ASSERT_TRUE(saved) << saved.error().message();
}

TEST(CalibrationRefused, ByTheControllerWithFileModuleAndReason) {
  const std::pair<DisplayCalibration, std::string> cases[] = {
      {mirrored_display(), "mirrored share"},
      {folded_display(), "folded share of the grid"},
      {display_folded_within_cells(), "folded share of the grid"}};
  for (const auto& [display, reason] : cases) {
    const Workbench bench;
    save(bench, display);
    const auto controller =
        start_program("lfd-controller", {bench.deployment("sink: NONE").string(), "--print-endpoint"});
    const auto exit = controller->wait(kPatience);
    ASSERT_TRUE(exit);
    EXPECT_EQ(exit->code, 1);
    EXPECT_THAT(controller->lines(), Contains(AllOf(HasSubstr("error: "), HasSubstr("display.textproto: "),
                                                    HasSubstr(reason), HasSubstr("--accept-calibration"))));
  }
}

TEST(CalibrationRefused, ButAcceptedByOptionOrDeployment) {
  const Workbench bench;
  save(bench, mirrored_display());
  EXPECT_THAT(start_controller(bench.deployment("sink: NONE"), {"--accept-calibration"}).process->lines(),
              Contains(HasSubstr("it is shown all the same")));
  start_controller(bench.deployment("sink: NONE accept_calibration: true", "accepted.textproto"));
}

TEST(CalibrationRefused, ByLfdUnlessItIsToldOtherwise) {
  const Workbench bench;
  save(bench, mirrored_display());
  const auto lfd =
      start_program("lfd", {"render", bench.deployment("").string(), "--out", (bench.folder() / "out").string()});
  const auto exit = lfd->wait(kPatience);
  ASSERT_TRUE(exit);
  EXPECT_EQ(exit->code, 1);
  EXPECT_THAT(lfd->lines(), Contains(AllOf(HasSubstr("error: controller: "), HasSubstr("mirrored share"))));
  const auto told = start_program("lfd", {"run", bench.deployment("").string(), "--accept-calibration"});
  EXPECT_TRUE(told->wait_for_line("running ", kPatience));
  EXPECT_TRUE(told->stop(kPatience).succeeded());
}

}  // namespace
}  // namespace lfd::harness
