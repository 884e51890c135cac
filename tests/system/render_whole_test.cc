// lfd render gives whole frames and says what of the scene it cannot show.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "tests/harness/workbench.h"

namespace lfd::harness {
namespace {

using namespace std::chrono_literals;
using testing::Contains;
using testing::HasSubstr;

constexpr auto kPatience = 60s;  // a software rasteriser starts slowly on a busy machine

// Files have time: the deadline of a show, here one that no node can keep, leaves no module stale.
TEST(LfdRenderWhole, FramesForFilesHaveNoDeadline) {
  const Workbench bench({256, 192});
  const auto out = bench.folder() / "out";
  const auto lfd = start_program("lfd", {"render", bench.deployment("pacing { heartbeat_ms: 100 deadline_ms: 1 }"),
                                         "--frames", "4", "--out", out, "--buffers", "color,position"});
  const auto exit = lfd->wait(kPatience);
  ASSERT_TRUE(exit);
  ASSERT_TRUE(exit->succeeded()) << lfd->lines().back();
  for (const char* frame : {"frame-0000", "frame-0003"}) {
    EXPECT_TRUE(std::filesystem::exists(out / frame / "module-003.position.exr")) << frame;
  }
}

// Requests for many frames are split; their numbers and reports go on.
TEST(LfdRenderWhole, ManyFramesAreReportedInOneFile) {
  const Workbench bench;
  const auto out = bench.folder() / "out";
  const auto lfd = start_program(
      "lfd", {"render", bench.deployment("pacing { heartbeat_ms: 100 }"), "--frames", "40", "--no-ao", "--out", out});
  const auto exit = lfd->wait(kPatience);
  ASSERT_TRUE(exit && exit->succeeded()) << lfd->lines().back();
  const auto report = nlohmann::json::parse(*read_file(out / "report.json"));
  ASSERT_EQ(report["frames"].size(), 40U);
  for (std::size_t i = 0; i < 40; ++i) EXPECT_EQ(report["frames"][i]["frame"], i);
}

// A triangle whose file also asks for a camera, blending and a texture that it has no coordinates for.
TEST(LfdRenderWhole, WhatASceneAsksForInVainIsNamed) {
  const Workbench bench;
  const auto scene = bench.file("scene.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}], "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}],
    "materials": [{"alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
    "textures": [{"source": 0}], "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=="}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0},
                               {"attributes": {"POSITION": 0}, "material": 0}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
  const auto out = bench.folder() / "out";
  const auto lfd = start_program("lfd", {"render", bench.deployment("pacing { heartbeat_ms: 100 }"), "--scene", scene,
                                         "--frames", "1", "--out", out});
  const auto exit = lfd->wait(kPatience);
  ASSERT_TRUE(exit && exit->succeeded()) << lfd->lines().back();
  const std::string left_out = "not supported and left out: alpha blending (drawn opaque), cameras";
  const std::string untextured = "2 primitives are drawn without the texture of their material (the first is mesh 0";
  EXPECT_THAT(lfd->lines(), Contains("warning: " + left_out));
  EXPECT_THAT(lfd->lines(), Contains(HasSubstr("warning: " + untextured)));
  const auto report = nlohmann::json::parse(*read_file(out / "report.json"));
  EXPECT_THAT(report["warnings"], Contains(left_out));
}

}  // namespace
}  // namespace lfd::harness
