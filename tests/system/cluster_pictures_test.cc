// What a cluster of two nodes writes is what a renderer in this process draws of the same state, module by module.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/file.h"
#include "base/log.h"
#include "display/viewer.h"
#include "proto/calibration_file.h"
#include "proto/frame_files.h"
#include "proto/pictures/png.h"
#include "proto/settings.h"
#include "proto/state.h"
#include "tests/support/made.h"
#include "tests/support/rendering.h"
#include "tests/system/running_cluster.h"

namespace lfd::harness {
namespace {

using testing_support::draw_once;
using testing_support::find_image;
using testing_support::made_data;
using testing_support::unwrapped;

constexpr ImageSize kImage{64, 36};
constexpr const char* kEye = "0.1,0,2";
constexpr display::Eye kEyePoint{0.1, 0, 2};

// Shares that are no ranges: a module's number is not its place in its node.
const std::vector<std::uint32_t> kLeft{0, 3}, kRight{1, 2};
const std::string kDeployment =
    "name: \"wall\" display: \"display.textproto\" scene { made { name: \"room\" seed: 1 } }\n"
    "node { name: \"left\" modules: \"0\" modules: \"3\" } node { name: \"right\" modules: \"1-2\" }\n"
    "pacing { heartbeat_ms: 100 }";

class ClusterPictures : public testing::Test {
 protected:
  // Each node's modules by a renderer of their own, as the nodes do: edges are split for the modules that a renderer
  // has.
  std::vector<Picture8> drawn_here() const {
    std::vector<Picture8> pictures(display_.modules.size(), black_picture(kImage.width, kImage.height));
    for (const std::vector<std::uint32_t>* share : {&kLeft, &kRight}) {
      Renderer renderer(testing_support::context(), display_, *share);
      const FrameResult frame = draw_once(renderer, state_, scene_.assets, {});
      for (const std::uint32_t module : *share) {
        const ModuleImage* image = find_image(frame, module, proto::COLOR);
        if (image == nullptr || image->empty) {
          ADD_FAILURE() << "module " << module << " sees nothing of the scene";
          continue;
        }
        pictures[module].rgba.assign(image->bytes->begin(), image->bytes->end());
      }
    }
    return pictures;
  }

  Picture8 seen_of(const std::vector<Picture8>& pictures) const {
    std::vector<const Picture8*> pointers;
    for (const Picture8& picture : pictures) pointers.push_back(&picture);
    return unwrapped(display::viewer_picture(display_, pointers, kEyePoint, kImage.width, kImage.height));
  }

  // What a program of the cluster does to its end.
  void run(const std::vector<std::string>& arguments) const {
    const auto lfd = start_program("lfd", arguments);
    const auto exit = lfd->wait(kClusterPatience);
    ASSERT_TRUE(exit && exit->succeeded()) << testing::PrintToString(lfd->lines());
  }

  const Workbench bench_{kImage};
  const std::filesystem::path wall_ = bench_.file("room.textproto", kDeployment);
  const DisplayCalibration display_ = unwrapped(load_calibration(bench_.folder() / "display.textproto"));
  const SceneData scene_ = made_data("room");
  const proto::State state_ = testing_support::state_of(
      scene_, unwrapped(complete_roi(proto::RegionOfInterest(), scene_.scene, display_.screen)));
};

TEST_F(ClusterPictures, AreThoseOfARendererInThisProcess) {
  const auto out = bench_.folder() / "out";
  ASSERT_NO_FATAL_FAILURE(run({"render", wall_, "--out", out}));
  const auto report = read_file(out / "report.json");
  ASSERT_TRUE(report);
  const auto frame = nlohmann::json::parse(*report).at("frames").at(0);
  EXPECT_EQ(frame.at("state_hash").get<std::string>(), state_hash(state_));
  const std::vector<Picture8> expected = drawn_here();
  for (std::uint32_t module = 0; module < expected.size(); ++module) {
    const auto found = read_png(image_path(out, 0, module, proto::COLOR));
    ASSERT_TRUE(found) << found.error().message();
    // Byte for byte: the same program draws the same numbers.
    EXPECT_TRUE(*found == expected[module]) << "module " << module;
    for (std::uint32_t other = 0; other < module; ++other)
      EXPECT_FALSE(expected[other] == expected[module]) << "one could stand for the other: " << other << ", " << module;
  }
}

TEST_F(ClusterPictures, AreWhatAViewIsMadeOf) {
  const auto picture = bench_.folder() / "view.png";
  ASSERT_NO_FATAL_FAILURE(run({"view", wall_, "--eye", kEye, "--out", picture}));
  std::vector<Picture8> modules = drawn_here();
  const auto found = read_png(picture);
  ASSERT_TRUE(found) << found.error().message();
  // The same function made both of the same bytes.
  EXPECT_TRUE(*found == seen_of(modules));
  std::swap(modules[1], modules[2]);
  EXPECT_FALSE(*found == seen_of(modules)) << "the eye would not notice swapped modules";
}

}  // namespace
}  // namespace lfd::harness
