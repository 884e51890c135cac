// lfd: whole clusters of real processes, from their start to their last process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>

#include "tests/system/running_cluster.h"

namespace lfd::harness {
namespace {

using namespace std::chrono_literals;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

constexpr auto kPatience = 60s;  // a software rasteriser starts slowly on a busy machine
const std::string kQuick = "pacing { heartbeat_ms: 100 }";
// Of the lines of `lfd run`, which names the children that it had to kill.
const auto kNobodyWasKilled = Not(Contains(HasSubstr("it is killed")));

// Processes need a moment to be gone from the process table after they were killed.
bool none_left() {
  const auto deadline = Clock::now() + 2s;
  while (!descendants_named("lfd").empty() && Clock::now() < deadline) ::usleep(10'000);
  return descendants_named("lfd").empty();
}

TEST(LfdRun, EndsEverythingWithinTwoSecondsOfASignal) {
  const Workbench bench;
  for (const int signal : {SIGINT, SIGTERM}) {
    const Running running = run_cluster(bench.deployment(kQuick));
    ASSERT_TRUE(draws(running.endpoint, 2));
    EXPECT_THAT(descendants_named("lfd"), SizeIs(5));  // lfd, controller, display, two nodes
    running.lfd->signal(signal);
    const auto exit = running.lfd->wait(2s);
    ASSERT_TRUE(exit);
    EXPECT_TRUE(exit->succeeded()) << exit->text();
    EXPECT_THAT(descendants_named("lfd"), IsEmpty());
    EXPECT_THAT(running.lfd->lines(), kNobodyWasKilled);
  }
}

TEST(LfdRun, EndsEverythingWithinTwoSecondsInTheMiddleOfAFrame) {
  // 8 radii of 256 samples over eight million pixels: many seconds of drawing on a software rasteriser.
  const Workbench bench(ImageSize{2048, 1024});
  const auto deployment = bench.deployment("sink: NONE render { ao { samples: 256 radii: 8 } }");
  const Running running = run_cluster(deployment, {"--log-level", "debug"});
  ASSERT_TRUE(says(*running.lfd, "frame 0: begin"));
  ASSERT_TRUE(says(*running.lfd, "draws 2 modules with ", 2));
  if (lines_with(*running.lfd, "llvmpipe") == 0) GTEST_SKIP() << "a GPU is done with the frame too soon";
  ASSERT_FALSE(running.lfd->wait(1s));  // both nodes are in the middle of it then
  // Later it may be swapped without the nodes, which leave first.
  ASSERT_EQ(lines_with(*running.lfd, "frame 0: swap"), 0) << "the frame is done before the signal comes";
  running.lfd->signal(SIGINT);
  const auto exit = running.lfd->wait(2s);
  ASSERT_TRUE(exit);
  EXPECT_TRUE(exit->succeeded()) << exit->text();
  EXPECT_THAT(descendants_named("lfd"), IsEmpty());
  EXPECT_THAT(running.lfd->lines(), kNobodyWasKilled);
}

TEST(LfdRun, LeavesNoOrphanWhenItIsKilled) {
  const Workbench bench;
  const Running running = run_cluster(bench.deployment(kQuick));
  const std::vector<int> processes = descendants_named("lfd");
  EXPECT_THAT(processes, SizeIs(5));
  running.lfd->signal(SIGKILL);
  ASSERT_TRUE(running.lfd->wait(2s));
  const auto deadline = Clock::now() + 2s;
  while (std::ranges::any_of(processes, runs) && Clock::now() < deadline) ::usleep(10'000);
  EXPECT_TRUE(std::ranges::none_of(processes, runs));
}

TEST(LfdRun, SaysWhichChildDiedAndEndsTheOthers) {
  const Workbench bench;
  const Running running = run_cluster(bench.deployment(kQuick));
  ASSERT_TRUE(draws(running.endpoint, 1));
  const std::vector<int> nodes = descendants_named("lfd-rendernode");
  ASSERT_THAT(nodes, SizeIs(2));
  ::kill(nodes.front(), SIGKILL);
  const auto exit = running.lfd->wait(5s);
  ASSERT_TRUE(exit);
  EXPECT_EQ(exit->code, 1);
  const auto line = running.lfd->wait_for_line("error: ", kPatience);
  ASSERT_TRUE(line);
  EXPECT_THAT(*line, HasSubstr("signal 9"));
  EXPECT_TRUE(none_left());
}

TEST(LfdRun, RunsBesideAnother) {
  const Workbench bench;
  const Running first = run_cluster(bench.deployment(kQuick)), second = run_cluster(bench.deployment(kQuick));
  EXPECT_NE(first.endpoint, second.endpoint);
  EXPECT_TRUE(draws(first.endpoint, 2));
  EXPECT_TRUE(draws(second.endpoint, 2));
}

// The controller, its nodes and the display go in any order.
TEST(LfdRun, EndsWellWhenAClientQuits) {
  const Workbench bench;
  for (int round = 0; round < 3; ++round) {
    const Running running = run_cluster(bench.deployment(kQuick));
    if (round > 0) {
      ASSERT_TRUE(draws(running.endpoint, 1));
    }
    const auto quit = start_program("lfd", {"ctl", "quit", "--controller", running.endpoint});
    const auto said = quit->wait(kPatience);
    ASSERT_TRUE(said);
    EXPECT_TRUE(said->succeeded()) << quit->lines().back();
    const auto exit = running.lfd->wait(kPatience);
    ASSERT_TRUE(exit);
    EXPECT_TRUE(exit->succeeded()) << running.lfd->lines().back();
  }
  EXPECT_TRUE(none_left());
}

class TakenAddress : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(LfdRun, TakenAddress, testing::Values("control", "state", "bulk", "images"),
                         [](const auto& address) { return std::string(address.param); });

// With a deadline, a frame that waits for anything but its nodes would count as late.
TEST_P(TakenAddress, IsNamedWithItsOwnerAndTheFirstClusterLosesNothing) {
  const Workbench bench;
  const std::string endpoint = "tcp://127.0.0.1:" + std::to_string(free_port());
  const auto deployment = bench.deployment("sink: DISPLAY pacing { heartbeat_ms: 50 deadline_ms: 1000 } addresses { " +
                                           std::string(GetParam()) + ": \"" + endpoint + "\" }");
  const Running first = run_cluster(deployment);
  ASSERT_TRUE(draws(first.endpoint, 2));
  const auto second = start_program("lfd", {"run", deployment});
  const auto exit = second->wait(2s);
  ASSERT_TRUE(exit);
  EXPECT_EQ(exit->code, 1);
  const auto line = second->wait_for_line(endpoint, kPatience);
  ASSERT_TRUE(line);
  EXPECT_THAT(*line, HasSubstr(std::string(GetParam()) == "images" ? "(lfd-display)" : "(lfd-controller)"));
  const auto before = status_at(first.endpoint);
  ASSERT_TRUE(before);
  ASSERT_TRUE(draws(first.endpoint, 2));
  const auto status = status_at(first.endpoint);
  ASSERT_TRUE(status);
  EXPECT_GT(status->frame(), before->frame());
  EXPECT_EQ(status->late_frames(), 0u);
  EXPECT_EQ(status->stale_modules(), 0u);
}

TEST(Lfd, ItsProgramsSayWhatWasMeantByAWrongOption) {
  for (const char* program : {"lfd-display", "lfd-scene", "lfd-controller", "lfd-rendernode"}) {
    const auto process = start_program(program, {"--versoin"});
    const auto exit = process->wait(kPatience);
    ASSERT_TRUE(exit);
    EXPECT_EQ(exit->code, 2) << program;
    const auto line = process->wait_for_line("error: ", kPatience);
    ASSERT_TRUE(line) << program;
    EXPECT_THAT(*line, HasSubstr("did you mean --version?")) << program;
  }
}

TEST(Lfd, ItsProgramsExitWithTwoOnWrongUse) {
  const Workbench bench;
  const std::string wall = bench.deployment(kQuick);
  for (const auto& [program, arguments] :
       {std::pair<const char*, std::vector<std::string>>{"lfd-scene",
                                                         {"make", "plane", "--out", "y.glb", "--width", "-1"}},
        {"lfd-scene", {"make", "plane", "--out", "y.glb", "--seed", "-1"}},
        {"lfd-scene", {"make", "plane", "--out", "y.glb", "--seed", "4294967296"}},
        {"lfd-scene", {"make", "plane", "--out", "y.gltf"}},
        {"lfd-calibrate", {"make", "desk", "--grid", "1000000x1000000", "--out", "y"}},
        {"lfd-calibrate", {"make", "desk", "--modules", "1024", "--grid", "4096x4096", "--out", "y"}},
        {"lfd-calibrate", {"make", "desk", "--perturb", "-1"}},
        {"lfd-calibrate", {"make", "desk", "--grids", "csv", "--out", "y"}},
        {"lfd-calibrate", {"export", "x", "--out", "y.mpcdi", "--size", "-1", "5"}},
        {"lfd-calibrate", {"import", "x", "--origin", "0,0"}},
        {"lfd-controller", {wall, "--roi", "0,0,0,1,1"}},
        {"lfd-display", {"sheet", "--frames-dir", "x", "--out", "y.jpg"}},
        {"lfd-display", {"sheet", "--frames-dir", "x", "--out", "y.png", "--tile-width", "0"}},
        {"lfd-rendernode", {wall, "--name", "nope"}}}) {
    const auto exit = start_program(program, arguments)->wait(kPatience);
    ASSERT_TRUE(exit);
    EXPECT_EQ(exit->code, 2) << program << " " << testing::PrintToString(arguments);
  }
}

TEST(Lfd, ExitsWithTwoOnWrongUse) {
  const Workbench bench;
  const std::string wall = bench.deployment(kQuick);
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"rendr"},
        {"render"},
        {"run", "--modul", "3"},
        {"render", "x", "--out", "y", "--buffers", "colour"},
        {"run", wall, "--roi", "1,2"},
        {"run", wall, "--roi", "0,0,0,1,0,1"},
        {"run", wall, "--roi", "0,0,0,1,1,-1"},
        {"ctl", "roi", "0,0,0,1,1,-1"},
        {"ctl", "roi", "--physical", "0,0,0,1e9,1,1"},
        {"ctl", "roi", "--orientation", "0,0,0,0"},
        {"run", wall, "--module", "99"},
        {"run", wall, "--module", "x"},
        {"run", wall, "--module", "1,,2"},
        {"run", wall, "--roi", "nan,0,0,1,1,1"},
        {"render", wall, "--out", "y", "--buffers", "color,,ao"},
        {"ctl", "--controller", "foo", "status"},
        {"ctl", "roi", "nan"},
        {"ctl", "roi", "--whole", "0,0,0,1,1,1"},
        {"ctl", "ao", "--on", "--off"},
        {"ctl", "ao", "--samples", "0"},
        {"ctl", "ao", "--samples", "1000"},
        {"ctl", "ao", "--radii", "9"},
        {"ctl", "ao", "--method", "foo"},
        {"ctl", "ao", "--set", "shell"},
        {"ctl", "ao", "--set", "directions=abc"},
        {"ctl", "ao", "--set", "directions=99999999999"},
        {"ctl", "ao", "--method", "alchemy", "--set", "directions=16"},
        {"ctl", "ao", "--seed", "-1"},
        {"ctl", "ao", "--seed", "4294967296"},
        {"ctl", "ao", "--seed", "99999999999999999999"},
        {"ctl", "scene", ""},
        {"ctl", "ao", "--generator", "foo"},
        {"bench", "frame", wall, "--module", "99"},
        {"bench", "frame", wall, "--gpu", "99"},
        {"view", wall, "--out", "y.png", "--eye", "0,0,nan"},
        {"view", wall, "--out", "y.png", "--place", "0", "--frames-dir", "x", "--no-ao"},
        {"run", wall, "--log-level", "loud"},
        {"view", wall, "--out", "y.png", "--eye", "0,0"},
        {"view", wall, "--out", "y.jpg", "--eye", "0,0,1"},
        {"view", wall, "--out", "y.png", "--eye", "0,0,-1"}}) {
    const auto exit = start_program("lfd", arguments)->wait(kPatience);
    ASSERT_TRUE(exit);
    EXPECT_EQ(exit->code, 2) << testing::PrintToString(arguments);
  }
}

TEST(Lfd, SaysThatThereIsNoFolderForTemporaryFiles) {
  const Workbench bench;
  const std::string wall = bench.deployment(kQuick), none = bench.folder() / "none";
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"view", wall, "--place", "0", "--out", bench.folder() / "eye.png"},
        {"bench", "soak", "--faults", "1"},
        {"bench", "cluster", "--out", bench.folder() / "cluster"}}) {
    std::vector<std::string> command{"TMPDIR=" + none, std::string(LFD_BIN_DIR) + "/lfd"};
    command.insert(command.begin(), "/usr/bin/env");
    command.insert(command.end(), arguments.begin(), arguments.end());
    const auto lfd = Process::start({.name = "lfd", .command = command, .on_line = {}, .environment = {}});
    ASSERT_TRUE(lfd) << lfd.error().message();
    const auto exit = (*lfd)->wait(kPatience);
    EXPECT_TRUE(exit && exit->code == 1) << testing::PrintToString(arguments);
    EXPECT_THAT((*lfd)->lines(), Contains(HasSubstr("TMPDIR " + none))) << testing::PrintToString(arguments);
  }
}

}  // namespace
}  // namespace lfd::harness
