// Truth: what modules show against each pixel's own line cast into the scene in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>

#include "base/file.h"
#include "bench/reference/scene_maker.h"
#include "calibration/import/format.h"
#include "calibration/make.h"
#include "controller/scene/made/made_scenes.h"
#include "tests/foreign_files.h"
#include "tests/gl/truth_case.h"
#include "tests/support/made.h"

namespace lfd {
namespace {

using reference::SceneMaker;
using testing_support::expect_true;
using testing_support::made_data;
using testing_support::TruthCase;
using testing_support::unwrapped;
using testing_support::whole_scene;

SceneData sphere_before_wall() {
  SceneMaker maker;
  const auto plain = maker.add_material({});
  maker.add_mesh(reference::sphere({0.1F, 0, 0.1F}, 0.3F, 40), plain);
  maker.add_quad({-1, -1, -0.4F}, {1, -1, -0.4F}, {1, 1, -0.4F}, {-1, 1, -0.4F}, plain);
  maker.add_quad({-1, -0.4F, 0.8F}, {1, -0.4F, 0.8F}, {1, -0.4F, -0.5F}, {-1, -0.4F, -0.5F}, plain);
  return maker.data();
}

TEST(Truth, SphereBeforeWall) {
  for (const auto diffuser : {Diffuser::kLinear, Diffuser::kConical}) {
    const char* name = diffuser == Diffuser::kLinear ? "sphere, linear" : "sphere, conical";
    expect_true(
        {name, sphere_before_wall(), reference::one_module(diffuser, {512, 384}), {0}, reference::same_spaces()});
  }
}

// Displays: modules in the middle of the row and at its end.
struct Shown {
  const char* name;
  DisplayCalibration display;
  std::vector<std::uint32_t> modules;
};

Shown shown_on(const std::string& name) {
  if (name == "linear") return {"crs4", unwrapped(make_display("crs4")), {36, 0}};
  // Not the very last module of c80-conical: it sees Sponza's roof at 0.2 degrees beside a wall seen from the front. A
  // hundredth of a pixel, what a rasteriser with corners at 1/256 px resolves, is 1e-3 of the diagonal on that roof
  // (one pixel of 592 613 shows the wall's edge instead: 1.08e-3).
  if (name == "conical") return {"c80-conical", unwrapped(make_display("c80-conical")), {40, 1}};
  return {"desk, perturbed", perturbed(unwrapped(make_display("desk")), 7), {3, 0}};
}

class TruthOnDisplays : public testing::TestWithParam<const char*> {
 protected:
  void expect_true_with(const std::string& scene_name, const SceneData& data) const {
    const Shown shown = shown_on(GetParam());
    expect_true(
        {scene_name + " on " + shown.name, data, shown.display, shown.modules, whole_scene(data.scene, shown.display)});
  }
};
INSTANTIATE_TEST_SUITE_P(Displays, TruthOnDisplays, testing::Values("linear", "conical", "perturbed"),
                         [](const auto& display) { return std::string(display.param); });

// Twelve triangles, the viewer's side open.
TEST_P(TruthOnDisplays, Room) { expect_true_with("room", made_data("room")); }

TEST_P(TruthOnDisplays, RibbedShell) { expect_true_with("ribbed shell", made_data("ribbed-shell")); }

TEST_P(TruthOnDisplays, Armadillo) {
  LFD_FOREIGN_FILE(path, "scenes/armadillo.glb");
  expect_true_with("armadillo", unwrapped(load_scene(path)).data);
}

TEST_P(TruthOnDisplays, Dragon) {
  LFD_FOREIGN_FILE(path, "scenes/dragon.glb");
  expect_true_with("dragon", unwrapped(load_scene(path)).data);
}

TEST_P(TruthOnDisplays, VikingRoom) {
  LFD_FOREIGN_FILE(path, "scenes/viking_room.glb");
  expect_true_with("viking room", unwrapped(load_scene(path)).data);
}

TEST_P(TruthOnDisplays, Sponza) {
  LFD_FOREIGN_FILE(path, "scenes/sponza/Sponza.gltf");
  expect_true_with("sponza", unwrapped(load_scene(path)).data);
}

// The region of interest is a part of the nave, seen along it: the building surrounds screen and viewer and crosses
// both limits in z.
TEST_P(TruthOnDisplays, InsideSponza) {
  LFD_FOREIGN_FILE(path, "scenes/sponza/Sponza.gltf");
  const Shown shown = shown_on(GetParam());
  const double aspect = shown.display.screen.width_m / shown.display.screen.height_m;
  RegionOfInterest roi;
  roi.world_centre = {0, 2.5, 0};
  roi.world_size = {3 * aspect, 3, 3};
  roi.world_orientation = glm::angleAxis(0.5 * M_PI, glm::dvec3(0, 1, 0));
  roi.physical_size = shown.display.screen.height_m * glm::dvec3(aspect, 1, 1);
  expect_true({std::string("inside sponza on ") + shown.name, unwrapped(load_scene(path)).data, shown.display,
               shown.modules, roi});
}

// Single precision has steps of 6 cm there; the instance is placed, and the region of interest follows it.
TEST_P(TruthOnDisplays, FarFromTheOrigin) {
  SceneData data = made_data("ribbed-shell");
  const Shown shown = shown_on(GetParam());
  RegionOfInterest roi = whole_scene(data.scene, shown.display);
  const Vector3<World> move{1e6, -1e6, 1e6};
  for (auto& instance : *data.scene.mutable_instance()) {
    auto& placement = *instance.mutable_world_from_mesh();
    placement[3] += move.x;
    placement[7] += move.y;
    placement[11] += move.z;
  }
  roi.world_centre = roi.world_centre + move;
  expect_true(
      {std::string("ribbed shell far away on ") + shown.name, data, shown.display, {shown.modules.front()}, roi});
}

class TruthOnForeignDisplays : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Files, TruthOnForeignDisplays,
                         testing::Values("holovizio-21.json", "projectors-aligned-41.yaml", "projectors-low-25.yaml"),
                         [](const auto& file) {
                           std::string name = file.param;
                           std::ranges::replace_if(
                               name, [](char c) { return std::isalnum(c) == 0; }, '_');
                           return name;
                         });

TEST_P(TruthOnForeignDisplays, RibbedShell) {
  LFD_FOREIGN_FILE(path, std::string("displays/") + GetParam());
  const auto text = read_file(path);
  ASSERT_TRUE(text) << text.error().message();
  const auto format = foreign_format_of(*text);
  ASSERT_TRUE(format);
  const auto display = import_display(*format, *text, GetParam());
  ASSERT_TRUE(display) << display.error().message();
  const SceneData data = made_data("ribbed-shell");
  const auto last = static_cast<std::uint32_t>(display->modules.size() - 1);
  expect_true({std::string("ribbed shell on ") + GetParam(),
               data,
               *display,
               {last / 2, last},
               whole_scene(data.scene, *display)});
}

}  // namespace
}  // namespace lfd
