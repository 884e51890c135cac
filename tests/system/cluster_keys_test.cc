// Clusters with keys, of real processes: pictures are the same, and whoever has the wrong key learns it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "base/file.h"
#include "base/log.h"
#include "base/version.h"
#include "proto/calibration_file.h"
#include "proto/frame_files.h"
#include "tests/harness/played_node.h"
#include "tests/support/unwrapped.h"
#include "tests/system/cluster_keys.h"
#include "tests/system/running_cluster.h"

namespace lfd::harness {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::AnyOf;
using testing::Contains;
using testing::HasSubstr;
using testing_support::unwrapped;

constexpr ImageSize kImage{64, 48};

// Runs a program to its end; its exit code.
int run_to_end(const std::string& program, const std::vector<std::string>& arguments, std::vector<std::string>& lines) {
  const auto process = start_program(program, arguments);
  const auto exit = process->wait(kClusterPatience);
  lines = process->lines();
  return exit ? exit->code : -1;
}

TEST(ClusterKeys, PicturesAreThoseOfAClusterWithout) {
  const Workbench bench(kImage);
  const KeyedDeployment keyed(bench, "");
  const auto plain = bench.deployment("", "plain.textproto");
  std::vector<std::string> lines;
  for (const auto& [deployment, out] : {std::pair{keyed.file, "keyed"}, std::pair{plain, "plain"}}) {
    const auto folder = (bench.folder() / out).string();
    ASSERT_EQ(
        run_to_end("lfd", {"render", deployment.string(), "--frames", "2", "--out", folder, "--buffers", "ao"}, lines),
        0)
        << testing::PrintToString(lines);
  }
  for (std::uint32_t module = 0; module < 4; ++module) {
    for (const proto::BufferKind kind : {proto::COLOR, proto::AO}) {
      const auto bytes = [&](const char* out) {
        return unwrapped(read_file(image_path(bench.folder() / out, 1, module, kind)));
      };
      EXPECT_EQ(bytes("keyed"), bytes("plain")) << module;
    }
  }
}

TEST(ClusterKeys, ControlGoesByRights) {
  const Workbench bench(kImage);
  const KeyedDeployment keyed(bench, "pacing { frames_per_second: 20 }");
  const Running running = run_cluster(keyed.file);
  ASSERT_FALSE(running.endpoint.empty());
  EXPECT_THAT(ctl(running, {"status"}), Contains(HasSubstr("wall"))) << "the running cluster names the operator's key";
  const auto ask = [&](const std::string& key, const char* what, std::vector<std::string>& lines) {
    return run_to_end("lfd", {"ctl", "--controller", running.endpoint, "--key", key, what}, lines);
  };
  std::vector<std::string> lines;
  EXPECT_EQ(ask(keyed.key("guest"), "status", lines), 0) << testing::PrintToString(lines);
  EXPECT_EQ(ask(keyed.key("guest"), "quit", lines), 1);
  EXPECT_THAT(lines, Contains(HasSubstr("error: the key of \"guest\" has no right CONTROL")));
  EXPECT_TRUE(says(*running.lfd, "a request is refused: the key of \"guest\" has no right CONTROL"));
  EXPECT_EQ(ask(keyed.key("left"), "status", lines), 1);
  EXPECT_THAT(lines, Contains(HasSubstr("error: the key of \"left\" has no right STATUS")));
  EXPECT_EQ(ask(keyed.stranger(), "status", lines), 1);
  EXPECT_THAT(lines, Contains(AllOf(HasSubstr("error: no controller answers"), HasSubstr("the key is refused"))));
  EXPECT_TRUE(says(*running.lfd, "is not in allow.textproto"));
  EXPECT_EQ(ask(keyed.misled_guest(), "status", lines), 1);
  EXPECT_THAT(lines,
              Contains(AllOf(HasSubstr("error: no controller answers"), HasSubstr("another than the allow-list"))));
  EXPECT_TRUE(draws({running.endpoint, keyed.key("ann")}, 5));
  EXPECT_EQ(ask(keyed.key("ann"), "quit", lines), 0) << testing::PrintToString(lines);
  const auto exit = running.lfd->wait(kClusterPatience);
  EXPECT_TRUE(exit && exit->succeeded());
}

TEST(ClusterKeys, JoinsNeedTheKeyOfWhoJoins) {
  const Workbench bench;
  const KeyedDeployment keyed(bench, "sink: NONE");
  const RunningController controller = start_controller(keyed.file);
  const auto refusal = [&](const std::string& name, const std::string& key, proto::Role role) {
    PlayedNode peer(name, controller.endpoint, {.role = role, .process = 7, .key_file = keyed.key(key)});
    EXPECT_TRUE(play_until({&peer}, [&] { return peer.refusal || peer.welcome; }));
    return peer.refusal.value_or("");
  };
  EXPECT_EQ(refusal("left", "guest", proto::NODE), "the key of \"guest\" has no right NODE");
  EXPECT_EQ(refusal("left", "right", proto::NODE), "the key of \"right\" is not that of node \"left\"");
  EXPECT_EQ(refusal("left", "display", proto::NODE), "the key of \"display\" has no right NODE");
  EXPECT_EQ(refusal("display", "left", proto::DISPLAY), "the key of \"left\" has no right DISPLAY");
  EXPECT_TRUE(
      says(*controller.process, " with the key of \"guest\" is refused: the key of \"guest\" has no right NODE"));
  EXPECT_EQ(refusal("any name", "display", proto::DISPLAY), "");
  EXPECT_EQ(refusal("left", "left", proto::NODE), "");
  // Who is not listed is not heard at all, and the others go on.
  PlayedNode stranger("left", controller.endpoint, {.process = 8, .key_file = keyed.stranger()});
  PlayedNode right("right", controller.endpoint, {.process = 9, .key_file = keyed.key("right")});
  EXPECT_TRUE(play_until({&stranger, &right}, [&] { return right.holds_state(); }));
  EXPECT_TRUE(says(*controller.process, "is not in allow.textproto"));
  EXPECT_FALSE(stranger.welcome);
  EXPECT_FALSE(stranger.refusal);
}

// What is refused without keys is refused with them too.
class EitherWay : public testing::TestWithParam<bool> {
 protected:
  std::filesystem::path deployment(const Workbench& bench, const std::string& more) const {
    return GetParam() ? KeyedDeployment(bench, more).file : bench.deployment(more);
  }
  std::string key(const Workbench& bench, const std::string& name) const {
    return GetParam() ? (bench.folder() / "keys" / (name + ".key")).string() : "";
  }
};
INSTANTIATE_TEST_SUITE_P(ClusterKeys, EitherWay, testing::Bool(),
                         [](const auto& test) { return test.param ? "WithKeys" : "Plain"; });

TEST_P(EitherWay, AnotherVersionIsRefusedAndBothSidesAreTold) {
  const Workbench bench;
  const RunningController controller = start_controller(deployment(bench, "sink: NONE"));
  PlayedNode old("left", controller.endpoint, {.version = "0.0.1", .key_file = key(bench, "left")});
  ASSERT_TRUE(play_until({&old}, [&] { return old.refusal.has_value(); }));
  const std::string reason = fmt::format("version 0.0.1 does not fit the controller's {}", kVersion);
  EXPECT_EQ(*old.refusal, reason);
  EXPECT_TRUE(says(*controller.process, "\"left\" (process 1) is refused: " + reason));
}

TEST_P(EitherWay, ANodeWithoutACalibrationIsRefusedAndBothSidesAreTold) {
  const Workbench bench;
  const RunningController controller = start_controller(deployment(bench, "sink: NONE"));
  PlayedNode blank("left", controller.endpoint, {.calibration_hash = "", .key_file = key(bench, "left")});
  ASSERT_TRUE(play_until({&blank}, [&] { return blank.refusal.has_value(); }));
  const std::string reason =
      fmt::format("display calibration (none) is not the controller's {}", Workbench::display_hash());
  EXPECT_EQ(*blank.refusal, reason);
  EXPECT_TRUE(says(*controller.process, "\"left\" (process 1) is refused: " + reason));
}

TEST_P(EitherWay, ANodeWithAnotherCalibrationEndsAndBothSidesAreTold) {
  const Workbench bench;
  const auto file = deployment(bench, "");
  DisplayCalibration other = unwrapped(load_calibration(bench.folder() / "display.textproto"));
  other.name = "another";
  ASSERT_TRUE(save_calibration(bench.folder() / "other.textproto", other));
  const RunningController controller = start_controller(file);
  const std::vector<std::string> at{"--controller", controller.endpoint, "--display",
                                    (bench.folder() / "other.textproto").string()};
  const auto refused = [&](const std::string& program, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), file.string());
    arguments.insert(arguments.end(), at.begin(), at.end());
    std::vector<std::string> lines;
    EXPECT_EQ(run_to_end(program, arguments, lines), 1) << program;
    EXPECT_THAT(lines, Contains(AllOf(HasSubstr("error: "), HasSubstr("refused: display calibration")))) << program;
  };
  refused("lfd-rendernode", {"--name", "left"});
  EXPECT_TRUE(says(*controller.process, "\"left\" (process "));
  refused("lfd-display", {});
  EXPECT_TRUE(says(*controller.process, "is refused: display calibration", 2));
}

TEST(ClusterKeys, ARenderNodeThatIsNotListedSaysSoAndWaits) {
  const Workbench bench;
  const KeyedDeployment keyed(bench, "");
  const RunningController controller = start_controller(keyed.file);
  const auto node = start_program("lfd-rendernode", {keyed.file.string(), "--name", "left", "--controller",
                                                     controller.endpoint, "--key", keyed.stranger()});
  EXPECT_TRUE(says(*node, "the key is refused: the listener's allow-list does not let it in here"));
  EXPECT_TRUE(says(*controller.process, "not let in: 127.0.0.1: the key "));
  EXPECT_FALSE(node->poll());
}

TEST(ClusterKeys, WhatCannotBeIsSaidBeforeAnythingStarts) {
  const Workbench bench;
  const auto plain = bench.deployment("", "plain.textproto").string();
  const KeyedDeployment keyed(bench, "");
  const auto says_at_once = [](const std::string& program, const std::vector<std::string>& arguments, int code,
                               const std::string& what) {
    std::vector<std::string> lines;
    EXPECT_EQ(run_to_end(program, arguments, lines), code) << program << testing::PrintToString(arguments);
    EXPECT_THAT(lines, Contains(HasSubstr(what))) << program;
  };
  const std::string far = "tcp://10.0.0.1:5550", refused = "plain tcp beyond this machine is refused";
  says_at_once("lfd-rendernode", {plain, "--name", "left", "--controller", far}, 2, refused);
  says_at_once("lfd-display", {plain, "--controller", far}, 1, refused);
  says_at_once("lfd-display", {"--controller", "tcp://127.0.0.1:1", "--images", "tcp://10.0.0.1:1"}, 1, refused);
  says_at_once("lfd", {"ctl", "--controller", far, "status"}, 1, "--key, or say --accept-plain-tcp-beyond-loopback");
  says_at_once("lfd-controller", {plain, "--key", keyed.key("controller")}, 2, "the deployment works without keys");
  const std::string file = keyed.file.string();
  says_at_once("lfd-rendernode",
               {file, "--name", "left", "--controller", "tcp://127.0.0.1:1", "--key", keyed.key("right")}, 1,
               "right.key: the key of \"right\" is not that of \"left\"");
  says_at_once("lfd-controller", {file, "--key", keyed.key("ann")}, 1, "the key of \"ann\" has no right CONTROLLER");
  says_at_once("lfd-display", {file, "--controller", "tcp://127.0.0.1:1", "--key", keyed.key("left")}, 1,
               "the key of \"left\" has no right DISPLAY");
  ASSERT_EQ(::chmod(keyed.key("controller").c_str(), 0644), 0);
  says_at_once("lfd-controller", {keyed.file.string()}, 1, "is open to others (mode 0644)");
  std::filesystem::remove(keyed.key("display"));
  says_at_once("lfd-display", {keyed.file.string(), "--controller", "tcp://127.0.0.1:1"}, 1,
               "display.key: no such file; `lfd keys make`");
}

}  // namespace
}  // namespace lfd::harness
