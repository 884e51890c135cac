// lfd render and view where they cannot: one clear error, and what earlier renders left stays.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "tests/harness/workbench.h"

namespace lfd::harness {
namespace {

using namespace std::chrono_literals;
using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;

constexpr auto kPatience = 60s;  // a software rasteriser starts slowly on a busy machine
const std::string kQuick = "pacing { heartbeat_ms: 100 }";

TEST(LfdRenderRefused, SaysAtOnceAndOnceThatASceneIsMissing) {
  const Workbench bench;
  const auto lfd = start_program(
      "lfd", {"render", bench.deployment(kQuick), "--scene", "none.glb", "--out", bench.folder() / "out"});
  const auto exit = lfd->wait(5s);  // a client's patience with a controller that is not there is 10 s
  ASSERT_TRUE(exit);
  EXPECT_EQ(exit->code, 1);
  EXPECT_THAT(lfd->lines(), testing::ElementsAre("error: scene: none.glb: no such file"));
}

TEST(LfdRenderRefused, SaysAtOnceAndOnceWhyASceneCannotBeShown) {
  const Workbench bench;
  const std::string scene = bench.file("broken.gltf", "{\"asset\": 1");
  const auto lfd =
      start_program("lfd", {"render", bench.deployment(kQuick), "--scene", scene, "--out", bench.folder() / "out"});
  const auto exit = lfd->wait(5s);
  ASSERT_TRUE(exit);
  EXPECT_EQ(exit->code, 1);
  const auto lines = lfd->lines();
  EXPECT_EQ(std::ranges::count_if(lines, [](const auto& line) { return line.find("broken.gltf") != line.npos; }), 1);
  EXPECT_THAT(lines.back(), StartsWith("error: controller: exit code 1: scene: " + scene));
}

TEST(LfdRenderRefused, LeavesEarlierFramesWhereNothingComesInTheirPlace) {
  const Workbench bench;
  const auto out = bench.folder() / "out";
  const std::string wall = bench.deployment(kQuick);
  const auto render = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"render", wall, "--out", out, "--module", "1", "--no-ao"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return start_program("lfd", arguments)->wait(kPatience);
  };
  const auto first = render({});
  ASSERT_TRUE(first && first->succeeded());
  for (const std::string scene : {bench.folder() / "none.glb", bench.file("broken.gltf", "{")}) {
    const auto refused = render({"--scene", scene});
    ASSERT_TRUE(refused);
    EXPECT_EQ(refused->code, 1);
    EXPECT_TRUE(std::filesystem::exists(out / "frame-0000" / "module-001.color.png")) << scene;
    EXPECT_TRUE(std::filesystem::exists(out / "report.json")) << scene;
  }
}

TEST(LfdRenderRefused, LeavesAFolderToWhoRendersThere) {
  const Workbench bench;
  const auto out = bench.folder() / "out";
  ASSERT_TRUE(make_folder(out));
  const auto lock = FolderLock::take(out);
  ASSERT_TRUE(lock);
  const auto lfd = start_program("lfd", {"render", bench.deployment(kQuick), "--out", out});
  const auto exit = lfd->wait(kPatience);
  ASSERT_TRUE(exit);
  EXPECT_EQ(exit->code, 1);
  EXPECT_THAT(lfd->lines().back(), HasSubstr(out.string() + ": another process writes there"));
}

// Without commas between them, words behind an option are not its own.
TEST(LfdRender, TakesTheDeploymentBehindAList) {
  const Workbench bench;
  const auto out = bench.folder() / "out";
  const auto exit = start_program("lfd", {"render", "--out", out, "--roi", "0,0,0,1,1,1", "--buffers", "color,depth",
                                          "--no-ao", "--module", "1", bench.deployment(kQuick)})
                        ->wait(kPatience);
  ASSERT_TRUE(exit);
  EXPECT_TRUE(exit->succeeded());
  EXPECT_TRUE(std::filesystem::exists(out / "frame-0000" / "module-001.depth.exr"));
}

class UnownedModules : public testing::Test {
 protected:
  const Workbench bench_;
  const std::string wall_ = bench_.file(
      "half.textproto",
      "display: \"display.textproto\" scene { made { name: \"room\" } } node { name: \"one\" modules: \"0\" modules: "
      "\"2\" } " +
          kQuick);
  const std::filesystem::path out_ = bench_.folder() / "out";
};

TEST_F(UnownedModules, AreWarnedOf) {
  const auto lfd = start_program("lfd", {"render", wall_, "--out", out_, "--no-ao"});
  const auto exit = lfd->wait(kPatience);
  ASSERT_TRUE(exit);
  EXPECT_TRUE(exit->succeeded()) << lfd->lines().back();
  const std::string warning = "modules 1,3 stay dark: no node of the deployment draws them";
  EXPECT_THAT(lfd->lines(), Contains("warning: " + warning));
  const auto report = nlohmann::json::parse(*read_file(out_ / "report.json"));
  EXPECT_THAT(report["warnings"].get<std::vector<std::string>>(), testing::ElementsAre(warning));
}

TEST_F(UnownedModules, CannotBeAskedFor) {
  const auto lfd = start_program("lfd", {"render", wall_, "--out", out_, "--module", "1-2"});
  const auto exit = lfd->wait(kPatience);
  ASSERT_TRUE(exit);
  EXPECT_EQ(exit->code, 2);
  EXPECT_THAT(lfd->lines(), testing::ElementsAre("error: --module: 1: no node of the deployment draws it"));
}

}  // namespace
}  // namespace lfd::harness
