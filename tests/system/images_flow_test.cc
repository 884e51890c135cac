// How images travel through a whole cluster: every codec shows the same, what does not change is not sent again, and a
// display that stops costs frames.
#include <gtest/gtest.h>
#include <signal.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "base/file.h"
#include "base/log.h"
#include "proto/frame_files.h"
#include "proto/pictures/exr.h"
#include "proto/pictures/png.h"
#include "tests/system/running_cluster.h"
#include "tests/system/tcp_relay.h"
#include "tests/unit/gltf_maker.h"

namespace lfd::harness {
namespace {

namespace fs = std::filesystem;

constexpr ImageSize kImage{64, 48};

struct Rendered {
  fs::path out;
  nlohmann::json frames;

  std::uint64_t sum(int frame, const char* what) const {
    std::uint64_t sum = 0;
    for (const auto& node : frames[static_cast<std::size_t>(frame)]["nodes"]) sum += node[what].get<std::uint64_t>();
    return sum;
  }
  Picture8 color(std::uint32_t module) const { return *read_png(image_path(out, 0, module, proto::COLOR)); }
  PictureF depth(std::uint32_t module) const { return *read_exr(image_path(out, 0, module, proto::DEPTH)); }
};

// Two frames of a scene that does not move, colour and depth.
Rendered render(const Workbench& bench, const std::string& codec) {
  const auto deployment = bench.deployment("stream { codec: " + codec + " quality: 95 }", codec + ".textproto");
  Rendered rendered{bench.folder() / codec, {}};
  const auto lfd =
      start_program("lfd", {"render", deployment, "--frames", "2", "--buffers", "depth", "--out", rendered.out});
  const auto exit = lfd->wait(kClusterPatience);
  EXPECT_TRUE(exit && exit->succeeded()) << testing::PrintToString(lfd->lines());
  const auto text = read_file(rendered.out / "report.json");
  EXPECT_TRUE(text);
  if (text) rendered.frames = nlohmann::json::parse(*text)["frames"];
  return rendered;
}

TEST(ImagesFlow, EveryCodecShowsTheSameAndWhatDoesNotChangeIsNotSentAgain) {
  const Workbench bench(kImage);
  const Rendered raw = render(bench, "RAW_IMAGES"), zstd = render(bench, "ZSTD_IMAGES"),
                 jpeg = render(bench, "JPEG_IMAGES");
  ASSERT_FALSE(testing::Test::HasFailure());
  constexpr std::uint64_t kPixels = 4 * std::uint64_t{kImage.width} * kImage.height;  // of four modules
  EXPECT_EQ(raw.sum(0, "image_bytes"), kPixels * (4 + 16));
  EXPECT_LT(zstd.sum(0, "image_bytes"), raw.sum(0, "image_bytes"));
  EXPECT_LT(jpeg.sum(0, "image_bytes"), raw.sum(0, "image_bytes"));
  for (const Rendered* rendered : {&raw, &zstd, &jpeg}) {
    EXPECT_EQ(rendered->sum(0, "unchanged_images"), 0u);
    EXPECT_EQ(rendered->sum(1, "image_bytes"), 0u);
    EXPECT_EQ(rendered->sum(1, "unchanged_images"), 8u);
    EXPECT_TRUE(fs::exists(image_path(rendered->out, 1, 3, proto::DEPTH)));
  }
  for (std::uint32_t module = 0; module < 4; ++module) {
    const Picture8 color = raw.color(module), lossy = jpeg.color(module);
    EXPECT_TRUE(color == zstd.color(module)) << module;
    EXPECT_EQ(raw.depth(module).rgba, zstd.depth(module).rgba);
    EXPECT_EQ(raw.depth(module).rgba, jpeg.depth(module).rgba) << "floats travel without loss";
    double sum = 0;
    for (std::size_t i = 0; i < color.rgba.size(); ++i) sum += std::abs(color.rgba[i] - lossy.rgba[i]);
    EXPECT_GT(sum, 0) << "it is JPEG";
    EXPECT_LT(sum / static_cast<double>(color.rgba.size()), 3) << module;
  }
}

// A rectangle that moves through all modules' pictures, there and back in two seconds.
std::string moving_gltf() {
  test::GltfMaker maker;
  const float x = 0.3f, y = 0.4f;
  maker.root["meshes"][0]["primitives"][0]["attributes"]["POSITION"] =
      maker.add_floats({-x, -y, 0, x, -y, 0, x, y, 0, -x, -y, 0, x, y, 0, -x, y, 0}, "VEC3");
  maker.root["nodes"][0]["mesh"] = 0;
  maker.root["scenes"][0]["nodes"] = {0};
  maker.animate("translation", "LINEAR", {0, 1, 2}, {-0.4f, 0, 0, 0.4f, 0, 0, -0.4f, 0, 0});
  return maker.gltf();
}

TEST(ImagesFlow, ADisplayThatStopsCostsFramesAndNeverMemory) {
  const Workbench bench({320, 240});
  bench.file("moving.gltf", moving_gltf());
  const auto deployment = bench.file("moving.textproto",
                                     "name: \"moving\" display: \"display.textproto\"\n"
                                     "scene { file: \"moving.gltf\" frames_per_second: 50 }\n"
                                     "roi { world_centre {} world_size { x: 1.6 y: 0.9 z: 0.2 } }\n"
                                     "node { name: \"left\" } node { name: \"right\" }\n"
                                     "render { ao { enabled: false } } stream { waiting_mib: 1 }\n"
                                     "pacing { heartbeat_ms: 5000 deadline_ms: 500 frames_per_second: 30 }");
  const Running running = run_cluster(deployment);
  ASSERT_TRUE(draws(running.endpoint, 5));
  const auto displays = descendants_named("lfd-display"), nodes = descendants_named("lfd-rendernode");
  ASSERT_EQ(displays.size(), 1u);
  ASSERT_EQ(nodes.size(), 2u);
  const auto all_bytes = [&] {
    return resident_bytes(nodes[0]) + resident_bytes(nodes[1]) + resident_bytes(displays[0]);
  };
  const std::size_t running_bytes = all_bytes();
  ASSERT_EQ(::kill(displays[0], SIGSTOP), 0);
  const std::uint64_t first = status_at(running.endpoint)->frame();
  // Once nothing goes any more, frames go on without new images, and nothing grows.
  ASSERT_TRUE(becomes(running.endpoint, [&](const auto& status) { return status.stale_modules() == 4; }));
  const std::size_t before = all_bytes();
  ASSERT_TRUE(becomes(running.endpoint, [&](const auto& status) { return status.frame() >= first + 60; }));
  const std::size_t after = all_bytes();
  // As stream.proto has it, of each node: a frame of its two images at 16 bytes a pixel waits in the display or on its
  // way there, which is more than waiting_mib; three frames at 4 bytes in the node. Beside that, what allocators keep.
  constexpr std::size_t kPixels = 2 * 320 * 240, kBound = 2 * kPixels * (16 + 3 * 4), kRest = 8u << 20;
  EXPECT_LT(after, running_bytes + kBound + kRest);
  EXPECT_LT(after, before + (8u << 20)) << "60 frames of 1.2 MiB were drawn";
  ASSERT_EQ(::kill(displays[0], SIGCONT), 0);
  EXPECT_TRUE(draws(running.endpoint, 5)) << "whole ones again";
}

// Nodes do not see that the display at their address is another one: their connections are made anew in silence.
TEST(ImagesFlow, ADisplayThatWasKilledComesBackAtTheSameAddress) {
  const Workbench bench(kImage);
  const std::string control = fmt::format("tcp://127.0.0.1:{}", free_port());
  const auto deployment = bench.deployment(
      fmt::format("sink: DISPLAY pacing {{ heartbeat_ms: 100 frames_per_second: 20 }} stream {{ codec: ZSTD_IMAGES }}\n"
                  "addresses {{ control: \"{}\" images: \"tcp://127.0.0.1:{}\" }}",
                  control, free_port()));
  const auto controller = start_program("lfd-controller", {deployment});
  const auto left = start_program("lfd-rendernode", {deployment, "--name", "left"});
  const auto right = start_program("lfd-rendernode", {deployment, "--name", "right"});
  for (const char* out : {"first", "second", "third"}) {
    const auto display = start_program("lfd-display", {deployment, "--out", bench.folder() / out});
    ASSERT_TRUE(says(*display, "sends images", 2)) << testing::PrintToString(display->lines());
    ASSERT_TRUE(draws(control, 1));
    const auto status = status_at(control);
    ASSERT_TRUE(status);
    EXPECT_TRUE(written_picture(bench.folder() / out, status->frame() + 5, 3)) << out;
    display->signal(SIGKILL);
    ASSERT_TRUE(display->wait(kClusterPatience));
    ASSERT_TRUE(becomes(control, [](const auto& now) { return peer_in(now, "display").state() == "out"; }));
  }
}

}  // namespace
}  // namespace lfd::harness
