// lfd render and view: what they write, and what they say where they cannot.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/version.h"
#include "tests/harness/workbench.h"
#include "tests/system/running_cluster.h"

namespace lfd::harness {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr auto kPatience = 60s;  // a software rasteriser starts slowly on a busy machine
const std::string kQuick = "pacing { heartbeat_ms: 100 }";

TEST(LfdRender, WritesImagesAndAReport) {
  const Workbench bench;
  const auto out = bench.folder() / "out";
  const auto lfd = start_program(
      "lfd", {"render", bench.deployment(kQuick), "--frames", "2", "--buffers",
              "color,position,normal,ao,depth,bent_normal", "--out", out, "--module", "1-2", "--roi=0.25,0,0,2,1,1"});
  const auto exit = lfd->wait(kPatience);
  ASSERT_TRUE(exit);
  ASSERT_TRUE(exit->succeeded()) << lfd->lines().back();
  for (const char* name : {"color.png", "position.exr", "normal.exr", "ao.exr", "depth.exr", "bent_normal.exr"}) {
    EXPECT_TRUE(std::filesystem::exists(out / "frame-0001" / ("module-001." + std::string(name)))) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(out / "frame-0000" / "module-000.color.png"));
  const auto report = nlohmann::json::parse(*read_file(out / "report.json"));
  ASSERT_EQ(report["frames"].size(), 2u);
  const auto& frame = report["frames"][0];
  EXPECT_EQ(frame["physical_from_world"].size(), 16u);
  EXPECT_EQ(frame["nodes"].size(), 2u);
  // The screen is 1.6 x 0.9 m: two metres fit it at 0.8.
  EXPECT_NEAR(frame["physical_from_world"][0].get<double>(), 0.8, 1e-15);
  EXPECT_NEAR(frame["physical_from_world"][3].get<double>(), -0.2, 1e-15);
  EXPECT_EQ(report["version"], kVersion);
  for (const auto& node : frame["nodes"]) {
    EXPECT_EQ(node["state_hash"], frame["state_hash"]);
    EXPECT_EQ(node["version"], kVersion);
    EXPECT_FALSE(node["renderer"].get<std::string>().empty());
    EXPECT_FALSE(node["passes"].empty());
    for (const auto& left : node["left_out"]) EXPECT_NE(left["why"], "");
  }
  EXPECT_TRUE(descendants_named("lfd").empty());
}

TEST(LfdRender, LeavesNoFramesOfAnEarlierRender) {
  const Workbench bench;
  const auto out = bench.folder() / "out";
  const auto render = [&](const char* frames, const char* module) {
    const auto lfd = start_program(
        "lfd", {"render", bench.deployment(kQuick), "--frames", frames, "--out", out, "--module", module, "--no-ao"});
    const auto exit = lfd->wait(kPatience);
    EXPECT_TRUE(exit && exit->succeeded());
    return lfd->lines();
  };
  render("2", "1");
  EXPECT_THAT(render("1", "2"), testing::Contains(HasSubstr("2 frames of an earlier render are removed")));
  EXPECT_FALSE(std::filesystem::exists(out / "frame-0001"));
  EXPECT_FALSE(std::filesystem::exists(out / "frame-0000" / "module-001.color.png"));
  EXPECT_TRUE(std::filesystem::exists(out / "frame-0000" / "module-002.color.png"));
}

TEST(LfdRender, WarnsWhereNothingOfTheSceneIsSeen) {
  const Workbench bench;
  const auto out = bench.folder() / "out";
  for (const char* roi : {"0,0,1000,1,1,1", "1000,0,0,1,1,1", "0,0,0,1e9,1e9,1e9"}) {
    const auto lfd = start_program(
        "lfd", {"render", bench.deployment(kQuick), "--out", out, std::string("--roi=") + roi, "--no-ao"});
    const auto exit = lfd->wait(kPatience);
    ASSERT_TRUE(exit);
    EXPECT_TRUE(exit->succeeded());
    EXPECT_THAT(lfd->lines(), testing::Contains(testing::StartsWith("warning: nothing of the scene is seen: "))) << roi;
    const auto report = nlohmann::json::parse(*read_file(out / "report.json"));
    EXPECT_EQ(report["warnings"].size(), 1u);
  }
}

TEST(LfdView, SaysWhichPicturesAreMissingAndThatAnEyeIsUnlit) {
  const Workbench bench;
  const auto out = bench.folder() / "out";
  const std::string wall = bench.deployment(kQuick);
  const auto render =
      start_program("lfd", {"render", wall, "--out", out, "--module", "1-2", "--no-ao"})->wait(kPatience);
  ASSERT_TRUE(render && render->succeeded());
  const auto view = start_program(
      "lfd", {"view", wall, "--frames-dir", out, "--eye", "30,0,2", "--out", bench.folder() / "view.png"});
  const auto exit = view->wait(kPatience);
  ASSERT_TRUE(exit && exit->succeeded());
  EXPECT_THAT(view->lines(), testing::Contains(HasSubstr("without the pictures of modules 0, 3")));
  EXPECT_THAT(view->lines(), testing::Contains(testing::AllOf(HasSubstr("no module lights this eye"),
                                                              HasSubstr("shows the light of the nearest"))));
}

TEST(LfdView, WritesWhatAViewerSees) {
  const Workbench bench;
  const auto picture = bench.folder() / "view.png";
  const auto lfd =
      start_program("lfd", {"view", bench.deployment(kQuick), "--eye", "-0.1,0,2", "--out", picture, "--no-ao"});
  const auto exit = lfd->wait(kPatience);
  ASSERT_TRUE(exit);
  ASSERT_TRUE(exit->succeeded()) << lfd->lines().back();
  EXPECT_TRUE(std::filesystem::exists(picture));
}

TEST(LfdRender, EndsWithinTwoSecondsOfASignalInTheMiddleOfAFrame) {
  const Workbench bench(ImageSize{2048, 1024});
  const std::string wall = bench.deployment("render { ao { samples: 256 radii: 8 } }");
  const std::string out = bench.folder() / "out", picture = bench.folder() / "view.png";
  for (const int signal : {SIGINT, SIGTERM}) {
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"render", wall, "--out", out, "--log-level", "debug"},
          {"view", wall, "--eye", "0,0,2", "--out", picture, "--log-level", "debug"}}) {
      const auto lfd = start_program("lfd", arguments);
      ASSERT_TRUE(says(*lfd, "frame 0: begin"));
      ASSERT_FALSE(lfd->wait(1s));
      if (lines_with(*lfd, "llvmpipe") == 0) GTEST_SKIP() << "a GPU is done with the frame too soon";
      ASSERT_EQ(lines_with(*lfd, "frame 0: swap"), 0) << "the frame is done before the signal comes";
      lfd->signal(signal);
      const auto exit = lfd->wait(2s);
      ASSERT_TRUE(exit);
      EXPECT_EQ(exit->code, 1) << exit->text();
      EXPECT_THAT(lfd->lines(), testing::Contains(HasSubstr("ended by signal " + std::to_string(signal))));
      EXPECT_TRUE(descendants_named("lfd").empty());
      EXPECT_FALSE(std::filesystem::exists(picture));
    }
  }
}

TEST(LfdView, APlaceIsAnEyeOnTheObserversLine) {
  const Workbench bench;
  const auto out = bench.folder() / "out", by_place = bench.folder() / "a.png", by_eye = bench.folder() / "b.png";
  const std::string wall = bench.deployment(kQuick);
  const auto render = start_program("lfd", {"render", wall, "--out", out, "--no-ao"})->wait(kPatience);
  ASSERT_TRUE(render && render->succeeded());
  for (const auto& [eye, picture] :
       {std::pair<std::string, std::string>{"--place=-0.25", by_place}, {"--eye=-0.4,0,2", by_eye}}) {
    const auto exit = start_program("lfd", {"view", wall, "--frames-dir", out, eye, "--out", picture})->wait(kPatience);
    ASSERT_TRUE(exit && exit->succeeded());
  }
  EXPECT_EQ(*read_file(by_place), *read_file(by_eye));
}

}  // namespace
}  // namespace lfd::harness
