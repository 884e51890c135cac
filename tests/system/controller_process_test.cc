// The controller as a process, between played nodes and clients: joins, frames, faults, scenes, ends.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>

#include "cli/control_client.h"
#include "tests/harness/played_node.h"
#include "tests/harness/workbench.h"

namespace lfd::harness {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr auto kPatience = 20s;
const std::string kQuick = "sink: NONE pacing { heartbeat_ms: 50 }";

ControlClient client_of(const RunningController& controller) {
  auto client = ControlClient::connect(controller.endpoint);
  EXPECT_TRUE(client);
  return *std::move(client);
}

proto::Status status_of(const RunningController& controller) {
  proto::Request request;
  request.mutable_status();
  const auto reply = client_of(controller).ask(request, kPatience);
  EXPECT_TRUE(reply);
  return reply->status();
}

std::string state_of(const RunningController& controller, const std::string& name) {
  const proto::Status status = status_of(controller);
  for (const proto::PeerStatus& peer : status.peer()) {
    if (peer.name() == name) return peer.state();
  }
  return "";
}

bool both_in(const PlayedNode& left, const PlayedNode& right) {
  return !left.swaps.empty() && left.swaps.back().stale_modules().empty() && !right.swaps.empty();
}

TEST(ControllerProcess, GivesANodeModulesStateAndAssets) {
  const Workbench bench;
  const auto controller = start_controller(bench.deployment(kQuick));
  PlayedNode left("left", controller.endpoint);
  ASSERT_TRUE(play_until({&left}, [&] { return left.holds_state(); }));
  EXPECT_THAT(left.welcome->modules(), ElementsAre(0, 1));
  EXPECT_GT(left.state.scene().light_size(), 0);
  EXPECT_TRUE(left.state.roi().has_physical_size());
  EXPECT_FALSE(left.assets.empty());
}

TEST(ControllerProcess, DrawsWithNodesThatCameBeforeAndAfterIt) {
  const Workbench bench;
  const int port = free_port();
  const std::string endpoint = "tcp://127.0.0.1:" + std::to_string(port);
  PlayedNode early("left", endpoint);
  play_until(
      {&early}, [] { return false; }, 200ms);
  const auto controller = start_controller(bench.deployment(kQuick + " addresses { control: \"" + endpoint + "\" }"));
  PlayedNode late("right", endpoint);
  ASSERT_TRUE(play_until({&early, &late}, [&] { return both_in(early, late); }));
}

TEST(ControllerProcess, LetsALateNodeInWithTheSameState) {
  const Workbench bench;
  const auto controller = start_controller(bench.deployment(kQuick));
  PlayedNode left("left", controller.endpoint);
  ASSERT_TRUE(play_until({&left}, [&] { return left.swaps.size() > 20; }));
  EXPECT_THAT(left.swaps.back().stale_modules(), ElementsAre(2, 3));
  PlayedNode right("right", controller.endpoint);
  ASSERT_TRUE(play_until({&left, &right}, [&] { return both_in(left, right); }));
  EXPECT_EQ(left.state_hash(), right.state_hash());
  EXPECT_EQ(status_of(controller).state_hash(), right.state_hash());
}

TEST(ControllerProcess, SwapsInOrderAndNeverHasMoreThanTwoFramesOpen) {
  const Workbench bench;
  const auto controller = start_controller(bench.deployment(kQuick));
  PlayedNode left("left", controller.endpoint), right("right", controller.endpoint);
  ASSERT_TRUE(play_until({&left, &right}, [&] {
    EXPECT_LE(left.begun.size(), left.swaps.size() + 2);
    return left.swaps.size() > 200 && both_in(left, right);
  }));
  for (std::size_t i = 1; i < left.swaps.size(); ++i) ASSERT_EQ(left.swaps[i].frame(), left.swaps[i - 1].frame() + 1);
}

TEST(ControllerProcess, RefusesWithReasons) {
  const Workbench bench;
  const auto controller = start_controller(bench.deployment(kQuick));
  PlayedNode left("left", controller.endpoint);
  ASSERT_TRUE(play_until({&left}, [&] { return left.welcome.has_value(); }));
  PlayedNode stranger("middle", controller.endpoint);
  PlayedNode twin("left", controller.endpoint, {.process = 2});
  PlayedNode old("right", controller.endpoint, {.version = "0.0.1"});
  PlayedNode other("right", controller.endpoint, {.calibration_hash = "c"});
  ASSERT_TRUE(play_until({&left, &stranger, &twin, &old, &other},
                         [&] { return stranger.refusal && twin.refusal && old.refusal && other.refusal; }));
  EXPECT_THAT(*stranger.refusal, HasSubstr("no node \"middle\""));
  EXPECT_THAT(*twin.refusal, HasSubstr("joined already"));
  EXPECT_THAT(*old.refusal, HasSubstr("version 0.0.1"));
  EXPECT_THAT(*other.refusal, HasSubstr("display calibration c is not the controller's"));
  EXPECT_FALSE(left.refusal);
}

TEST(ControllerProcess, SwapsWithoutAHungNodeAtTheDeadline) {
  const Workbench bench;
  const auto controller = start_controller(bench.deployment("sink: NONE pacing { heartbeat_ms: 50 deadline_ms: 100 }"));
  PlayedNode left("left", controller.endpoint), right("right", controller.endpoint);
  ASSERT_TRUE(play_until({&left, &right}, [&] { return both_in(left, right); }));
  right.habits.draws = false;
  ASSERT_TRUE(play_until({&left, &right}, [&] { return !left.swaps.back().stale_modules().empty(); }));
  EXPECT_THAT(left.swaps.back().stale_modules(), ElementsAre(2, 3));
  EXPECT_EQ(state_of(controller, "right"), "late");
  EXPECT_GT(status_of(controller).late_frames(), 0u);
  right.habits.draws = true;
  ASSERT_TRUE(play_until({&left, &right}, [&] { return left.swaps.back().stale_modules().empty(); }));
}

TEST(ControllerProcess, GoesOnWithoutADeadNodeAndTakesItBack) {
  const Workbench bench;
  const auto controller = start_controller(bench.deployment(kQuick));
  PlayedNode left("left", controller.endpoint);
  {
    PlayedNode right("right", controller.endpoint);
    ASSERT_TRUE(play_until({&left, &right}, [&] { return both_in(left, right); }));
  }
  const std::size_t before = left.swaps.size();
  ASSERT_TRUE(play_until({&left}, [&] { return left.swaps.size() > before + 10; }));
  EXPECT_THAT(left.swaps.back().stale_modules(), ElementsAre(2, 3));
  EXPECT_EQ(state_of(controller, "right"), "out");
  PlayedNode again("right", controller.endpoint, {.process = 7});
  ASSERT_TRUE(play_until({&left, &again}, [&] { return both_in(left, again); }));
}

TEST(ControllerProcess, TakesBackANodeThatWasSilent) {
  const Workbench bench;
  const auto controller = start_controller(bench.deployment(kQuick));
  PlayedNode left("left", controller.endpoint), right("right", controller.endpoint);
  ASSERT_TRUE(play_until({&left, &right}, [&] { return both_in(left, right); }));
  right.habits.beats = right.habits.draws = false;
  ASSERT_TRUE(play_until({&left}, [&] { return !left.swaps.back().stale_modules().empty(); }));
  right.habits.beats = right.habits.draws = true;
  ASSERT_TRUE(play_until({&left, &right}, [&] { return left.swaps.back().stale_modules().empty(); }));
}

TEST(ControllerProcess, DrawsAsManyFramesAsAskedForAndReportsThem) {
  const Workbench bench;
  const auto controller = start_controller(bench.deployment(kQuick), {"--idle"});
  PlayedNode left("left", controller.endpoint), right("right", controller.endpoint);
  ControlClient client = client_of(controller);
  proto::Request request;
  request.mutable_frames()->set_count(3);
  request.mutable_frames()->set_buffers(6);
  const auto id = client.send(request, kPatience);
  ASSERT_TRUE(id);
  std::optional<proto::Reply> reply;
  ASSERT_TRUE(play_until({&left, &right}, [&] { return (reply = client.receive(*id, 0s)).has_value(); }));
  ASSERT_EQ(reply->error(), "");
  ASSERT_EQ(reply->frame_size(), 3);
  EXPECT_EQ(left.state.buffers(), 6u);
  for (const proto::FrameReport& frame : reply->frame()) {
    EXPECT_EQ(frame.node_size(), 2);
    EXPECT_EQ(frame.state_hash(), left.state_hash());
    EXPECT_EQ(frame.node(0).state_hash(), frame.state_hash());
    EXPECT_EQ(frame.physical_from_world_size(), 16);
    EXPECT_EQ(frame.stale_module_size(), 0);
  }
  play_until(
      {&left, &right}, [] { return false; }, 200ms);
  EXPECT_THAT(left.begun, ElementsAre(0, 1, 2));
}

// Asks for frames while the nodes play.
proto::Reply reply_to_frames(const RunningController& controller, int count, std::initializer_list<PlayedNode*> nodes) {
  ControlClient client = client_of(controller);
  proto::Request request;
  request.mutable_frames()->set_count(count);
  const auto id = client.send(request, kPatience);
  EXPECT_TRUE(id);
  std::optional<proto::Reply> reply;
  EXPECT_TRUE(play_until(nodes, [&] { return (reply = client.receive(*id, 0s)).has_value(); }));
  return reply.value_or(proto::Reply());
}

TEST(ControllerProcess, AnswersWithTheErrorOfANodeThatCannotDraw) {
  const Workbench bench;
  const auto controller = start_controller(bench.deployment(kQuick), {"--idle"});
  PlayedNode left("left", controller.endpoint), right("right", controller.endpoint);
  left.habits.error = "out of memory";
  EXPECT_EQ(reply_to_frames(controller, 2, {&left, &right}).error(), "node \"left\": frame 0: out of memory");
  ASSERT_TRUE(play_until({&left, &right}, [&] { return right.swaps.size() == 2; }));
  for (const proto::SwapFrame& swap : right.swaps) EXPECT_THAT(swap.stale_modules(), ElementsAre(0, 1));
}

TEST(ControllerProcess, AnswersWithAnErrorWhereTheReportsFitIntoNoMessage) {
  const Workbench bench;
  // The nodes are silent while this process packs so long a report.
  const auto controller = start_controller(bench.deployment("sink: NONE pacing { heartbeat_ms: 1000 }"), {"--idle"});
  PlayedNode left("left", controller.endpoint), right("right", controller.endpoint);
  left.habits.report_bytes = std::size_t{3} << 20;  // less than the controller takes; 22 of them exceed 64 MiB
  EXPECT_THAT(reply_to_frames(controller, 22, {&left, &right}).error(), HasSubstr("ask for fewer frames"));
  left.habits.report_bytes = 0;
  EXPECT_FALSE(status_of(controller).scene().empty());
}

TEST(ControllerProcess, KeepsTheRunningSceneWhenAnotherIsBroken) {
  const Workbench bench;
  const auto controller = start_controller(bench.deployment(kQuick));
  PlayedNode left("left", controller.endpoint);
  ASSERT_TRUE(play_until({&left}, [&] { return !left.swaps.empty(); }));
  const std::string hash = left.state_hash();
  ControlClient client = client_of(controller);
  proto::Request request;
  request.set_scene_file(bench.file("broken.gltf", "{ \"asset\": ").string());
  const auto id = client.send(request, kPatience);
  ASSERT_TRUE(id);
  std::optional<proto::Reply> reply;
  ASSERT_TRUE(play_until({&left}, [&] { return (reply = client.receive(*id, 0s)).has_value(); }));
  EXPECT_THAT(reply->error(), HasSubstr("broken.gltf"));
  EXPECT_EQ(status_of(controller).state_hash(), hash);
  const std::size_t before = left.swaps.size();
  EXPECT_TRUE(play_until({&left}, [&] { return left.swaps.size() > before; }));
}

TEST(ControllerProcess, ChangesWhatAClientWishesAndRefusesWhatCannotBe) {
  const Workbench bench;
  const auto controller = start_controller(bench.deployment(kQuick));
  PlayedNode left("left", controller.endpoint);
  ASSERT_TRUE(play_until({&left}, [&] { return left.holds_state(); }));
  ControlClient client = client_of(controller);
  proto::Request request;
  request.mutable_ao()->set_samples(1000);
  EXPECT_THAT(client.ask(request, kPatience).error().message(), HasSubstr("ao.samples: 1000"));
  request.mutable_ao()->set_samples(32);
  EXPECT_TRUE(client.ask(request, kPatience));
  request.mutable_roi()->mutable_world_size()->set_x(-1);
  EXPECT_FALSE(client.ask(request, kPatience));
  EXPECT_TRUE(play_until({&left}, [&] { return left.state.render().ao().samples() == 32; }));
}

TEST(ControllerProcess, EndsOnSignalsWithinTwoSecondsAndSaysQuit) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const Workbench bench;
    const auto controller = start_controller(bench.deployment(kQuick));
    PlayedNode left("left", controller.endpoint);
    ASSERT_TRUE(play_until({&left}, [&] { return !left.swaps.empty(); }));
    controller.process->signal(signal);
    const auto exit = controller.process->wait(2s);
    ASSERT_TRUE(exit);
    EXPECT_TRUE(exit->succeeded()) << exit->text();
    EXPECT_TRUE(play_until({&left}, [&] { return left.quit; }));
  }
}

TEST(ControllerProcess, NamesPortAndOwnerWhereItIsTaken) {
  const Workbench bench;
  const std::string endpoint = "tcp://127.0.0.1:" + std::to_string(free_port());
  const auto deployment = bench.deployment(kQuick + " addresses { control: \"" + endpoint + "\" }");
  auto first = start_controller(deployment);
  const auto second = start_program("lfd-controller", {deployment});
  const auto exit = second->wait(2s);
  ASSERT_TRUE(exit);
  EXPECT_EQ(exit->code, 1);
  const auto line = second->wait_for_line("error: ", kPatience);
  ASSERT_TRUE(line);
  EXPECT_THAT(*line, HasSubstr(endpoint));
  EXPECT_THAT(*line, HasSubstr("process " + std::to_string(first.process->id()) + " (lfd-controller)"));
  first.process->stop(2s);
  start_controller(deployment);  // the port is free again at once
}

TEST(ControllerProcess, RunsTwiceOnPortsOfItsOwn) {
  const Workbench bench;
  const auto first = start_controller(bench.deployment(kQuick)), second = start_controller(bench.deployment(kQuick));
  EXPECT_NE(first.endpoint, second.endpoint);
  PlayedNode one("left", first.endpoint), two("left", second.endpoint);
  EXPECT_TRUE(play_until({&one, &two}, [&] { return !one.swaps.empty() && !two.swaps.empty(); }));
}

TEST(ControllerProcess, FailsWhereItsFirstSceneCannotBeLoaded) {
  const Workbench bench;
  const auto controller = start_program("lfd-controller", {bench.deployment(kQuick), "--scene", "/nowhere.glb"});
  const auto exit = controller->wait(kPatience);
  ASSERT_TRUE(exit);
  EXPECT_EQ(exit->code, 1);
  EXPECT_TRUE(controller->wait_for_line("nowhere.glb", kPatience));
}

}  // namespace
}  // namespace lfd::harness
