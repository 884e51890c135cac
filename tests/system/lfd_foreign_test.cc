// Whole clusters on scenes and displays of others, and on a display of 64 modules over four nodes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "base/file.h"
#include "base/log.h"
#include "proto/pictures/exr.h"
#include "proto/pictures/png.h"
#include "tests/foreign_files.h"
#include "tests/harness/workbench.h"

namespace lfd::harness {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

std::string name_of_file(const testing::TestParamInfo<const char*>& info) {
  std::string name = fs::path(info.param).filename().string();
  std::ranges::replace_if(
      name, [](char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

// Runs `lfd render` with these arguments; the report it leaves.
nlohmann::json render(std::vector<std::string> arguments, const fs::path& out, Clock::duration patience) {
  arguments.insert(arguments.begin(), "render");
  for (const char* more : {"--frames", "1", "--log-level", "warn", "--out"}) arguments.emplace_back(more);
  arguments.push_back(out);
  const auto lfd = start_program("lfd", arguments);
  const auto exit = lfd->wait(patience);
  EXPECT_TRUE(exit && exit->succeeded()) << (lfd->lines().empty() ? "" : lfd->lines().back());
  const auto text = read_file(out / "report.json");
  EXPECT_TRUE(text);
  return text ? nlohmann::json::parse(*text) : nlohmann::json();
}

// Share of the pixels of a module's picture that are not background (black).
double drawn_share(const fs::path& picture_file) {
  const auto picture = read_png(picture_file);
  EXPECT_TRUE(picture);
  if (!picture) return 0;
  std::size_t drawn = 0;
  for (std::size_t i = 0; i < picture->rgba.size(); i += 4) {
    drawn += picture->rgba[i] + picture->rgba[i + 1] + picture->rgba[i + 2] > 0 ? 1 : 0;
  }
  return 4.0 * static_cast<double>(drawn) / static_cast<double>(picture->rgba.size());
}

// Share of the pixels of a module's position file that have a surface.
double surface_share(const fs::path& position_file) {
  const auto picture = read_exr(position_file);
  EXPECT_TRUE(picture) << (picture ? "" : picture.error().message());
  if (!picture) return 0;
  std::size_t surfaces = 0;
  for (std::size_t i = 3; i < picture->rgba.size(); i += 4) surfaces += picture->rgba[i] == 1 ? 1 : 0;
  return 4.0 * static_cast<double>(surfaces) / static_cast<double>(picture->rgba.size());
}

std::string desk() { return std::string(LFD_SOURCE_DIR) + "/configs/desk.textproto"; }

class ForeignScene : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Files, ForeignScene,
                         testing::Values("scenes/sponza/Sponza.gltf", "scenes/armadillo.glb", "scenes/dragon.glb",
                                         "scenes/viking_room.glb"),
                         name_of_file);

TEST_P(ForeignScene, IsShownByACluster) {
  LFD_FOREIGN_FILE(path, GetParam());
  const Workbench bench;
  const auto out = bench.folder() / "out";
  const auto report = render({desk(), "--scene", path, "--buffers", "position"}, out, 100s);
  ASSERT_TRUE(report.contains("frames"));
  for (const auto& node : report["frames"][0]["nodes"])
    EXPECT_EQ(node["state_hash"], report["frames"][0]["state_hash"]);
  // The scene is fitted to the screen: in the middle it takes a good part of the picture.
  EXPECT_GT(surface_share(out / "frame-0000" / "module-003.position.exr"), 0.1);
}

class ForeignDisplay : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Files, ForeignDisplay,
                         testing::Values("displays/holovizio-21.json", "displays/projectors-aligned-41.yaml",
                                         "displays/projectors-low-25.yaml"),
                         name_of_file);

TEST_P(ForeignDisplay, IsDrivenByACluster) {
  LFD_FOREIGN_FILE(path, GetParam());
  const Workbench bench;
  const auto display = bench.folder() / "imported.textproto";
  const auto import = start_program("lfd-calibrate", {"import", path, "--out", display});
  const auto imported = import->wait(20s);
  ASSERT_TRUE(imported && imported->succeeded());
  const auto deployment = bench.file("wall.textproto",
                                     "name: \"wall\" display: \"imported.textproto\" scene { made { name: \"room\" } } "
                                     "node { name: \"a\" } node { name: \"b\" }");
  const auto out = bench.folder() / "out";
  const auto report = render({deployment, "--module", "0,7,20", "--no-ao"}, out, 100s);
  ASSERT_TRUE(report.contains("frames"));
  for (const char* module : {"000", "007", "020"}) {
    EXPECT_GT(drawn_share(out / "frame-0000" / ("module-" + std::string(module) + ".color.png")), 0.1);
  }
}

// The scenes of others on the displays of others; --display shares its modules equally among the deployment's nodes.
class ForeignBoth : public testing::TestWithParam<std::pair<const char*, const char*>> {};
INSTANTIATE_TEST_SUITE_P(Files, ForeignBoth,
                         testing::Values(std::pair("scenes/sponza/Sponza.gltf", "displays/projectors-low-25.yaml"),
                                         std::pair("scenes/viking_room.glb", "displays/holovizio-21.json"),
                                         std::pair("scenes/armadillo.glb", "displays/projectors-aligned-41.yaml"),
                                         std::pair("scenes/dragon.glb", "displays/projectors-low-25.yaml")),
                         [](const auto& both) {
                           return fs::path(both.param.first).stem().string() + std::to_string(both.index);
                         });

TEST_P(ForeignBoth, AreShownWithOcclusion) {
  LFD_FOREIGN_FILE(scene, GetParam().first);
  LFD_FOREIGN_FILE(foreign, GetParam().second);
  const Workbench bench;
  const auto display = bench.folder() / "imported.textproto", out = bench.folder() / "out";
  const auto imported = start_program("lfd-calibrate", {"import", foreign, "--out", display})->wait(20s);
  ASSERT_TRUE(imported && imported->succeeded());
  const auto report = render(
      {desk(), "--scene", scene, "--display", display, "--module", "0,10,20", "--buffers", "position,ao"}, out, 110s);
  ASSERT_TRUE(report.contains("frames"));
  EXPECT_EQ(report["frames"][0]["stale_modules"].size(), 0u);
  EXPECT_GT(surface_share(out / "frame-0000" / "module-010.position.exr"), 0.05);
}

TEST(LargeDisplay, IsDrivenWholeByFourNodes) {
  const Workbench bench;
  const auto out = bench.folder() / "out";
  const auto report = render({std::string(LFD_SOURCE_DIR) + "/configs/640rc.textproto", "--no-ao"}, out, 110s);
  ASSERT_TRUE(report.contains("frames"));
  const auto& frame = report["frames"][0];
  ASSERT_EQ(frame["nodes"].size(), 4u);
  for (const auto& node : frame["nodes"]) EXPECT_EQ(node["state_hash"], frame["state_hash"]);
  std::set<std::string> different;
  for (int k = 0; k < 64; ++k) {
    const auto file = out / "frame-0000" / fmt::format("module-{:03}.color.png", k);
    EXPECT_GT(drawn_share(file), 0.05) << k;
    const auto bytes = read_file(file);
    ASSERT_TRUE(bytes);
    different.insert(*bytes);
  }
  EXPECT_EQ(different.size(), 64u) << "every module has a picture of its own";
}

}  // namespace
}  // namespace lfd::harness
