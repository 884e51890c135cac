// Another scene of 200 MB while a cluster runs: the old one is shown until every node has built the new one, then all
// change in the same frame.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <cstring>
#include <random>
#include <thread>

#include "base/file.h"
#include "base/log.h"
#include "cli/control_client.h"
#include "controller/scene/scene_builder.h"
#include "controller/scene/scene_file.h"
#include "proto/frame_files.h"
#include "proto/pictures/png.h"
#include "tests/harness/played_node.h"
#include "tests/system/fault_stage.h"
#include "tests/system/tcp_relay.h"

namespace lfd::harness {
namespace {

namespace fs = std::filesystem;

// A rectangle of a metre with corners' texture coordinates, facing the viewer, at z.
MeshArrays rectangle(float left, float right) {
  MeshArrays mesh;
  mesh.position = {{left, -0.5F, 0}, {right, -0.5F, 0}, {right, 0.5F, 0}, {left, 0.5F, 0}};
  mesh.normal.assign(4, {0, 0, 1});
  mesh.uv = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  mesh.index = {0, 1, 2, 0, 2, 3};
  return mesh;
}

// Noise, which no encoder makes smaller: the size of its file is that of its pixels.
std::string noise_png(int side, unsigned seed) {
  std::mt19937_64 random(seed);
  Picture8 picture{side, side, {}};
  picture.rgba.resize(std::size_t{4} * side * side);
  for (std::size_t i = 0; i + 8 <= picture.rgba.size(); i += 8) {
    const std::uint64_t bits = random();
    std::memcpy(picture.rgba.data() + i, &bits, 8);
  }
  return *encode_png(picture, PngChannels::kRgb);
}

fs::path write_scene(const fs::path& path, int pictures, int side) {
  scene::SceneBuilder builder("noise");
  for (int i = 0; i < pictures; ++i) {
    proto::Material material;
    material.set_unlit(true);
    material.mutable_texture()->set_picture(builder.add_picture(noise_png(side, static_cast<unsigned>(i))));
    const float width = 1.6F / static_cast<float>(pictures), left = -0.8F + width * static_cast<float>(i);
    const auto mesh = builder.add_mesh(rectangle(left, left + width));
    EXPECT_TRUE(mesh && builder.add_instance(*mesh, builder.add_material(material), glm::dmat4(1)));
  }
  const auto data = std::move(builder).finish();
  const Status written = scene::write_glb(path, *data);
  EXPECT_TRUE(written) << written.error().message();
  return path;
}

Status show_scene(const std::string& endpoint, const fs::path& scene) {
  LFD_TRY(ControlClient client, ControlClient::connect(endpoint));
  proto::Request request;
  request.set_scene_file(scene);
  LFD_TRY(const proto::Reply reply, client.ask(request, kClusterPatience));
  return reply.error().empty() ? Status() : Status(Error(reply.error()));
}

TEST(SceneChange, OfTwoHundredMegabytesIsAtomicAndDisturbsNobody) {
  // Without a deadline nothing may be stale, however slow the machine.
  FaultStage stage("", "pacing { frames_per_second: 20 heartbeat_ms: 100 }");
  const fs::path scene = write_scene(stage.deployment().parent_path() / "noise.glb", 4, 4224);
  EXPECT_GE(fs::file_size(scene), 200'000'000U);
  for (const char* const name : {"controller", "display", "left", "right"}) stage.start(name);
  ASSERT_TRUE(stage.is_whole());
  const std::uint64_t first = stage.last_frame();
  const auto old_pictures = stage.pictures_from(first);

  const Status shown = show_scene(stage.endpoint(), scene);
  ASSERT_TRUE(shown) << shown.error().message();
  const std::uint64_t changed = stage.last_frame();
  EXPECT_GE(changed, first + 20) << "frames of the old scene went on";
  ASSERT_TRUE(stage.is_whole());
  const auto new_pictures = stage.pictures_from(stage.last_frame());
  EXPECT_NE(new_pictures, old_pictures);

  // Every frame is wholly the old one or wholly the new one, and the old one is never back.
  bool is_new = false;
  for (std::uint64_t frame = first; frame < changed + 3; ++frame) {
    if (!fs::exists(image_path(stage.shown(), frame, 0, proto::COLOR))) continue;
    const auto pictures = stage.pictures_of(frame);
    if (pictures == new_pictures) is_new = true;
    EXPECT_EQ(pictures, is_new ? new_pictures : old_pictures) << frame;
  }
  for (const char* const name : {"left", "right", "display"}) EXPECT_FALSE(stage[name].poll());
  EXPECT_EQ(lines_with(stage["controller"], "is out"), 0) << "heartbeats were on time";
  EXPECT_EQ(lines_with(stage["left"], "nothing heard"), 0);
  EXPECT_EQ(lines_with(stage["controller"], "2 nodes prepare it"), 1);
}

// One that was away comes back while the new scene's assets are on their way to it: the spare draws until they are
// drawn once for nobody.
TEST(SceneChange, WhileANodeIsAwayCostsNoFrameOnceItIsBack) {
  FaultStage stage("node { name: \"reserve\" spare: true }");
  const fs::path scene = write_scene(stage.deployment().parent_path() / "noise.glb", 4, 2048);
  for (const char* const name : {"controller", "display", "reserve", "left", "right"}) stage.start(name);
  ASSERT_TRUE(stage.is_whole());
  stage["right"].signal(SIGSTOP);
  ASSERT_TRUE(stage.is_whole_by_spare());
  const Status shown = show_scene(stage.endpoint(), scene);
  ASSERT_TRUE(shown) << shown.error().message();
  const std::ptrdiff_t late_before = lines_with(stage["controller"], FaultStage::kLate);
  stage["right"].signal(SIGCONT);
  ASSERT_TRUE(stage.is_whole());
  EXPECT_EQ(lines_with(stage["controller"], FaultStage::kLate), late_before);
  const std::uint64_t frame = stage.last_frame();
  ASSERT_TRUE(stage.shows_frames_after(frame + 1));
  for (std::uint32_t module = 0; module < 4; ++module)
    EXPECT_TRUE(fs::exists(image_path(stage.shown(), frame, module, proto::COLOR))) << module;
}

// A spare that draws nothing is named in no frame; it must not hold the scene before until it is.
TEST(SceneChange, IsMadeByASpareAtRestToo) {
  FaultStage stage("node { name: \"reserve\" spare: true }");
  const fs::path scene = write_scene(stage.deployment().parent_path() / "noise.glb", 1, 64);
  for (const char* const name : {"controller", "display", "reserve", "left", "right"}) stage.start(name);
  ASSERT_TRUE(stage.is_whole());
  stage.kill("right");
  ASSERT_TRUE(stage.is_whole_by_spare());
  stage.start("right");
  ASSERT_TRUE(stage.is_whole());
  const Status shown = show_scene(stage.endpoint(), scene);
  ASSERT_TRUE(shown) << shown.error().message();
  EXPECT_TRUE(says(stage["reserve"], "draws scene noise from now on"));
}

// A node that says that it cannot draw it: everybody keeps the old one, and who asked hears why.
TEST(SceneChange, IsRefusedWhereANodeCannotDrawIt) {
  const Workbench bench;
  const auto controller = start_controller(bench.deployment("sink: NONE pacing { heartbeat_ms: 100 }"));
  PlayedNode left("left", controller.endpoint), right("right", controller.endpoint);
  right.habits.prepares = false;
  ASSERT_TRUE(play_until({&left, &right}, [&] { return left.named.size() > 2 && right.named.size() > 2; }));
  const std::string old_hash = left.state_hash();
  const fs::path scene = write_scene(bench.folder() / "noise.glb", 1, 16);
  std::optional<Status> answer;
  std::thread asks([&] { answer = show_scene(controller.endpoint, scene); });
  ASSERT_TRUE(play_until({&left, &right}, [&] { return right.prepare.has_value(); }));
  const std::size_t drawn = left.named.size();
  ASSERT_TRUE(play_until({&left, &right}, [&] { return left.named.size() > drawn + 5; })) << "frames go on";
  EXPECT_EQ(left.state_hash(), old_hash);
  right.say_prepared("no memory for it");
  ASSERT_TRUE(play_until({&left, &right}, [&] { return left.prepare && !left.prepare->has_update(); }));
  asks.join();
  ASSERT_TRUE(answer && !*answer);
  EXPECT_THAT(answer->error().message(), testing::HasSubstr("node \"right\": no memory for it"));
  EXPECT_EQ(left.state_hash(), old_hash);
}

TEST(SceneChange, ThatIsRefusedLeavesNothingInMemory) {
  const Workbench bench;
  const auto deployment = bench.deployment("sink: NONE pacing { heartbeat_ms: 100 }");
  const auto controller = start_controller(deployment);
  const auto left =
      start_program("lfd-rendernode", {deployment, "--name", "left", "--controller", controller.endpoint});
  PlayedNode right("right", controller.endpoint);
  right.habits.prepares = false;
  ASSERT_TRUE(play_until(
      {&right}, [&] { return !right.swaps.empty() && right.swaps.back().stale_modules_size() == 0; },
      kClusterPatience));
  const fs::path scene = write_scene(bench.folder() / "noise.glb", 2, 4224);
  const std::size_t before = resident_bytes(left->id()), assets = fs::file_size(scene);
  ASSERT_GE(assets, std::size_t{100'000'000});
  const std::jthread asks([&] { EXPECT_FALSE(show_scene(controller.endpoint, scene)); });
  // It begins to build it once all assets are here, and takes more then.
  ASSERT_TRUE(play_until(
      {&right}, [&] { return right.prepare && resident_bytes(left->id()) > before + assets * 3 / 2; },
      kClusterPatience));
  right.say_prepared("no memory for it");
  EXPECT_TRUE(play_until(
      {&right}, [&] { return resident_bytes(left->id()) < before + assets / 2; }, kClusterPatience))
      << resident_bytes(left->id()) - before << " bytes more than before";
}

// Restarted while the others prepare the new scene, it draws the old one: after the change it would have to load the
// new one first, and everybody would wait for it.
TEST(SceneChange, WaitsForANodeThatComesInBetween) {
  const Workbench bench;
  const auto controller = start_controller(bench.deployment("sink: NONE pacing { heartbeat_ms: 100 }"));
  PlayedNode left("left", controller.endpoint);
  std::optional<PlayedNode> right(std::in_place, "right", controller.endpoint);
  left.habits.prepares = right->habits.prepares = false;
  ASSERT_TRUE(play_until({&left, &*right}, [&] { return left.named.size() > 2 && right->named.size() > 2; }));
  const fs::path scene = write_scene(bench.folder() / "noise.glb", 1, 16);
  std::optional<Status> answer;
  std::jthread asks([&] { answer = show_scene(controller.endpoint, scene); });
  ASSERT_TRUE(play_until({&left, &*right}, [&] { return left.prepare && right->prepare; }));
  right->leave();
  ASSERT_TRUE(play_until({&left, &*right}, [&] { return lines_with(*controller.process, "is out: the play") == 1; }));
  PlayedNode::Habits slow;
  slow.prepares = false;
  slow.process = 2;
  right.emplace("right", controller.endpoint, slow);
  ASSERT_TRUE(play_until({&left, &*right}, [&] { return right->named.size() > 2 && right->prepare; }));
  left.say_prepared("");
  const std::size_t drawn = right->named.size();
  ASSERT_TRUE(play_until({&left, &*right}, [&] { return right->named.size() > drawn + 5; }));
  for (const PlayedNode* node : {&left, &*right}) EXPECT_NE(node->state.scene().name(), "noise");
  right->say_prepared("");
  ASSERT_TRUE(play_until({&left, &*right}, [&] {
    return left.state.scene().name() == "noise" && right->state.scene().name() == "noise";
  }));
  asks.join();
  EXPECT_TRUE(answer && *answer);
}

}  // namespace
}  // namespace lfd::harness
