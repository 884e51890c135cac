// The way of drawing that is the default keeps the bounds of `lfd bench map` on every calibration of the repository.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "bench/map/map_bench.h"
#include "proto/calibration_file.h"
#include "tests/gl/truth_case.h"
#include "tests/support/made.h"

namespace lfd {
namespace {

using testing_support::expect_true;
using testing_support::made_data;
using testing_support::unwrapped;
using testing_support::whole_scene;

std::vector<std::string> displays() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(LFD_SOURCE_DIR "/configs/displays"))
    names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

class DefaultWay : public testing::TestWithParam<std::string> {
 protected:
  // The module in the middle and the outermost ones.
  void expect_kept(const char* scene_name) const {
    const auto file = std::string(LFD_SOURCE_DIR "/configs/displays/") + GetParam() + ".textproto";
    const DisplayCalibration display = unwrapped(load_calibration(file));
    const SceneData data = made_data(scene_name);
    const auto count = static_cast<std::uint32_t>(display.modules.size());
    expect_true({std::string(scene_name) + " on " + GetParam(),
                 data,
                 display,
                 {count / 2, 0, count - 1},
                 whole_scene(data.scene, display),
                 bench::MapBounds{}});
  }
};
INSTANTIATE_TEST_SUITE_P(Displays, DefaultWay, testing::ValuesIn(displays()), [](const auto& display) {
  std::string name = display.param;
  std::erase(name, '-');
  return name;
});

TEST_P(DefaultWay, IsTrueInTheRoom) { expect_kept("room"); }
TEST_P(DefaultWay, IsTrueOnTheRibbedShell) { expect_kept("ribbed-shell"); }

}  // namespace
}  // namespace lfd
