// lfd ctl pattern against a running cluster: its pictures, those of nodes that join later, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "base/log.h"
#include "tests/system/running_cluster.h"

namespace lfd::harness {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::StartsWith;

const std::string kFiles = "sink: FILES files: \"frames\" pacing { heartbeat_ms: 100 frames_per_second: 10 } ";

// Two frames may be open at a time: the third one to come has the state.
constexpr std::uint64_t kFramesUntilShown = 3;

// The pictures of the four modules in a frame.
std::vector<Picture8> pictures_of(const Workbench& bench, std::uint64_t frame) {
  std::vector<Picture8> pictures;
  for (std::uint32_t module = 0; module < 4; ++module)
    pictures.push_back(written_picture(bench.folder() / "frames", frame, module).value_or(Picture8()));
  return pictures;
}

bool is_all(const Picture8& picture, std::array<std::uint8_t, 4> color) {
  for (std::size_t i = 0; i < picture.rgba.size(); ++i) {
    if (picture.rgba[i] != color[i % 4]) return false;
  }
  return !picture.rgba.empty();
}

TEST(LfdCtlPattern, ReplacesThePicturesOfAllModulesAndGivesThemBack) {
  const Workbench bench({64, 36});
  const Running running = run_cluster(bench.deployment(kFiles + "render { background { b: 0.5 } }"));
  ASSERT_TRUE(draws(running.endpoint, 1));
  const proto::Status before = settled_status(running);
  EXPECT_THAT(ctl(running, {"pattern"}), ElementsAre("pattern    off"));
  EXPECT_THAT(ctl(running, {"pattern", "number", "--color", "1,1,0"}), IsEmpty());
  const proto::Status shown = settled_status(running);
  EXPECT_NE(shown.state_hash(), before.state_hash());
  EXPECT_EQ(shown.render().pattern().kind(), proto::TestPattern::NUMBER);
  EXPECT_THAT(ctl(running, {"pattern"}), ElementsAre("pattern    number, colour 1,1,0"));
  EXPECT_THAT(ctl(running, {"status"}), Contains(MatchesRegex("pattern +number, colour 1,1,0")));
  const auto scene = pictures_of(bench, before.frame()),
             pattern = pictures_of(bench, shown.frame() + kFramesUntilShown);
  EXPECT_THAT(ctl(running, {"pattern", "off"}), IsEmpty());
  const proto::Status after = settled_status(running);
  EXPECT_EQ(after.state_hash(), before.state_hash());
  EXPECT_GT(after.sequence(), shown.sequence());

  const auto again = pictures_of(bench, after.frame() + kFramesUntilShown);
  for (std::size_t module = 0; module < 4; ++module) {
    EXPECT_TRUE(again[module] == scene[module]) << "module " << module;
    EXPECT_FALSE(pattern[module] == scene[module]) << "module " << module;
    for (std::size_t other = 0; other < module; ++other)
      EXPECT_FALSE(pattern[module] == pattern[other]) << "each its own number: " << module << ", " << other;
    ASSERT_EQ(pattern[module].rgba.size(), 64U * 36U * 4U);
    EXPECT_TRUE(
        std::equal(pattern[module].rgba.begin(), pattern[module].rgba.begin() + 3, std::array{255, 255, 0}.begin()))
        << "the frame";
  }
}

TEST(LfdCtlPattern, IsShownByANodeThatJoinsLater) {
  const Workbench bench;
  const std::string wall = bench.deployment(kFiles + "render { background { b: 0.5 } }");
  const RunningController controller = start_controller(wall);
  const Running running{nullptr, controller.endpoint};
  const auto left = start_program("lfd-rendernode", {wall, "--name", "left", "--controller", controller.endpoint});
  ASSERT_TRUE(becomes(controller.endpoint, [](const auto& s) { return peer_in(s, "left").state() == "ready"; }));
  ctl(running, {"pattern", "solid", "--color", "1,0,0.2", "--module", "1-2"});
  const auto right = start_program("lfd-rendernode", {wall, "--name", "right", "--controller", controller.endpoint});
  ASSERT_TRUE(becomes(controller.endpoint, [](const auto& s) { return peer_in(s, "right").state() == "ready"; }));
  const auto pictures = pictures_of(bench, settled_status(running).frame() + kFramesUntilShown);
  for (std::size_t module = 0; module < 4; ++module) {
    const std::array<std::uint8_t, 4> red{255, 0, 51, 255}, black{0, 0, 0, 255};
    EXPECT_TRUE(is_all(pictures[module], module == 1 || module == 2 ? red : black)) << "module " << module;
  }
}

struct Refused {
  std::vector<std::string> arguments;
  std::string error;
};

TEST(LfdCtlPattern, SaysWhatCannotBeAndChangesNothing) {
  const Workbench bench;
  const Running running = run_cluster(bench.deployment("sink: NONE pacing { heartbeat_ms: 100 }"));
  ASSERT_TRUE(draws(running.endpoint, 1));
  const std::string hash = settled_status(running).state_hash();
  const std::vector<Refused> cases{
      {{"stripes"}, "KIND: unknown kind stripes; checker, grid, number, off, solid are possible"},
      {{"gird"}, "KIND: unknown kind gird; did you mean grid?"},
      {{"grid", "--spacing-px", "-3"}, "--spacing-px: -3; whole numbers from 1 to 8192 are possible"},
      {{"grid", "--spacing-px", "0"}, "--spacing-px: 0; whole numbers from 1 to 8192 are possible"},
      {{"checker", "--space", "screen", "--spacing-m", "nan"}, "--spacing-m: nan; "},
      {{"checker", "--space", "glass"}, "--space: "},
      {{"number", "--spacing-px", "3"}, "pattern.spacing_px: is for kind GRID or CHECKER"},
      {{"grid", "--spacing-m", "0.1"}, "pattern.spacing_m: is for kind GRID or CHECKER in space SCREEN only"},
      {{"solid", "--color", "2,0,0"}, "--color: 0 to 1 are possible"},
      {{"solid", "--color", "1,0"}, "--color: 2 numbers; R,G,B is expected"},
      {{"number", "--module", "3-"}, "pattern.modules 0: \"3-\" is neither a module number nor a range"},
      {{"number", "--module", "0,2-4"}, "pattern.modules 1: 4; the display has modules 0 to 3"},
      {{"--module", "1"}, "--module requires KIND"},
      {{"off", "--module", "1"}, "pattern.kind: is missing or NONE beside other fields"},
      {{"number", "--modul", "1"}, "unknown option --modul; did you mean --module?"},
  };
  for (const Refused& one : cases) {
    std::vector<std::string> arguments{"ctl", "--controller", running.endpoint, "pattern"};
    arguments.insert(arguments.end(), one.arguments.begin(), one.arguments.end());
    const auto lfd = start_program("lfd", arguments);
    const auto exit = lfd->wait(kClusterPatience);
    ASSERT_TRUE(exit);
    EXPECT_EQ(exit->code, 2) << testing::PrintToString(one.arguments);
    EXPECT_EQ(lines_with(*lfd, "error: "), 1) << testing::PrintToString(lfd->lines());
    EXPECT_THAT(lfd->lines(), Contains(StartsWith("error: " + one.error)));
  }
  EXPECT_EQ(settled_status(running).state_hash(), hash);
}

TEST(LfdCtlPattern, ExplainsItself) {
  const auto lfd = start_program("lfd", {"ctl", "pattern", "--help"});
  const auto exit = lfd->wait(kClusterPatience);
  ASSERT_TRUE(exit && exit->succeeded());
  for (const char* word : {"number", "grid", "checker", "solid", "off", "--module", "--space", "--spacing-px",
                           "--spacing-m", "--color", "colour calibrations are left out"})
    EXPECT_THAT(lfd->lines(), Contains(HasSubstr(word)));
}

}  // namespace
}  // namespace lfd::harness
