// Daemons as services: what they tell the service manager, and the units that start them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <fstream>
#include <thread>

#include "base/file.h"
#include "base/log.h"
#include "tests/harness/notify_socket.h"
#include "tests/system/running_cluster.h"

namespace lfd::harness {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;

constexpr auto kWatchdog = 200ms;

std::unique_ptr<Process> start_service(const std::string& program, std::vector<std::string> arguments,
                                       const NotifySocket& socket) {
  arguments.insert(arguments.begin(), (std::filesystem::path(LFD_BIN_DIR) / program).string());
  auto process = Process::start(
      {.name = program, .command = std::move(arguments), .on_line = {}, .environment = socket.environment(kWatchdog)});
  LFD_CHECK(process, process.error().message());
  return *std::move(process);
}

// Hears so many signs of life.
testing::AssertionResult lives(NotifySocket& socket, int times) {
  for (int i = 0; i < times; ++i) {
    if (!socket.hears("WATCHDOG=1", kClusterPatience)) return testing::AssertionFailure() << "after " << i << " signs";
  }
  return testing::AssertionSuccess();
}

// Stopped, it says no word more; continued, it lives on.
void expect_silence_while_stopped(Process& process, NotifySocket& socket) {
  process.signal(SIGSTOP);
  const auto state = [&] {
    std::ifstream stat(fmt::format("/proc/{}/stat", process.id()));
    std::string id, name, letter;
    stat >> id >> name >> letter;
    return letter;
  };
  const auto deadline = Clock::now() + kClusterPatience;
  while (state() != "T" && Clock::now() < deadline) std::this_thread::sleep_for(1ms);
  while (socket.next(0ms)) {
  }
  EXPECT_FALSE(socket.next(3 * kWatchdog)) << socket.heard().back();
  process.signal(SIGCONT);
  EXPECT_TRUE(lives(socket, 3));
}

// SIGTERM: it says that it ends, and ends.
void expect_good_end(Process& process, NotifySocket& socket) {
  process.signal(SIGTERM);
  EXPECT_TRUE(socket.hears("STOPPING=1", kClusterPatience));
  const auto exit = process.wait(kClusterPatience);
  ASSERT_TRUE(exit);
  EXPECT_TRUE(exit->succeeded()) << exit->text();
}

TEST(Service, TheControllerIsReadyOnceItsSceneIsThere) {
  const Workbench bench;
  NotifySocket socket(bench.folder());
  const auto controller = start_service("lfd-controller", {bench.deployment(""), "--print-endpoint"}, socket);
  ASSERT_TRUE(socket.hears("READY=1", kClusterPatience)) << testing::PrintToString(controller->lines());
  EXPECT_TRUE(controller->wait_for_line("scene: plane is shown", kClusterPatience)) << "through another pipe";
  EXPECT_TRUE(lives(socket, 5));
  EXPECT_TRUE(socket.has_heard("STATUS=\"plane\": frame 0") ||
              socket.hears("STATUS=\"plane\": frame 0", kClusterPatience));
  expect_silence_while_stopped(*controller, socket);
  expect_good_end(*controller, socket);
  EXPECT_EQ(std::ranges::count(socket.heard(), "READY=1"), 1);
}

TEST(Service, AControllerWithoutASceneIsNeverReady) {
  const Workbench bench;
  NotifySocket socket(bench.folder());
  const auto controller =
      start_service("lfd-controller", {bench.deployment(""), "--scene", bench.file("no.gltf", "{}")}, socket);
  ASSERT_TRUE(socket.hears("STOPPING=1", kClusterPatience)) << testing::PrintToString(controller->lines());
  const auto exit = controller->wait(kClusterPatience);
  ASSERT_TRUE(exit);
  EXPECT_EQ(exit->code, 1);
  EXPECT_FALSE(socket.has_heard("READY=1"));
}

struct Joiner {
  const char* program;
  std::vector<std::string> arguments;  // the deployment is the first
};

class JoiningService : public testing::TestWithParam<Joiner> {};

TEST_P(JoiningService, IsReadyOnceTheControllerHasTakenItIn) {
  const Workbench bench;
  NotifySocket socket(bench.folder());
  const auto deployment = bench.deployment(
      fmt::format("addresses {{ control: \"tcp://127.0.0.1:{}\" }}\npacing {{ heartbeat_ms: 100 }}\n", free_port()));
  std::vector<std::string> arguments = GetParam().arguments;
  arguments.insert(arguments.begin(), deployment.string());
  const auto service = start_service(GetParam().program, arguments, socket);
  ASSERT_TRUE(lives(socket, 5)) << testing::PrintToString(service->lines());
  EXPECT_FALSE(socket.has_heard("READY=1")) << "the controller is away";
  EXPECT_FALSE(service->poll());
  EXPECT_THAT(testing::PrintToString(socket.heard()), HasSubstr("joins tcp://"));
  const auto controller = start_controller(deployment);
  ASSERT_TRUE(socket.hears("READY=1", kClusterPatience)) << testing::PrintToString(service->lines());
  EXPECT_TRUE(says(*service, "joined"));
  EXPECT_TRUE(socket.hears("STATUS=", kClusterPatience));
  EXPECT_TRUE(lives(socket, 3));
  expect_silence_while_stopped(*service, socket);
  expect_good_end(*service, socket);
}

INSTANTIATE_TEST_SUITE_P(Service, JoiningService,
                         testing::Values(Joiner{"lfd-rendernode", {"--name", "left"}}, Joiner{"lfd-display", {}}),
                         [](const auto& one) { return std::string(one.param.program).substr(4); });

// The units, as they would stand beside the programs of the build.
class Units : public testing::Test {
 protected:
  static constexpr const char* kNames[] = {"lfd-controller.service", "lfd-display.service", "lfd-rendernode@.service"};

  Units() {
    for (const char* name : kNames) {
      std::string text = *read_file(std::filesystem::path(LFD_SOURCE_DIR) / "configs/systemd" / name);
      for (auto at = text.find(kInstalled); at != text.npos; at = text.find(kInstalled, at + 1))
        text.replace(at, std::string(kInstalled).size(), std::string("ExecStart=") + LFD_BIN_DIR + "/");
      bench.file(name, text);
    }
  }

  void SetUp() override {
    if (!std::filesystem::exists(kAnalyze)) GTEST_SKIP() << kAnalyze << " is missing (package systemd)";
  }

  // Exit and lines of systemd-analyze.
  std::pair<Exit, std::vector<std::string>> analyze(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), kAnalyze);
    auto process =
        Process::start({.name = "systemd-analyze", .command = std::move(arguments), .on_line = {}, .environment = {}});
    LFD_CHECK(process, process.error().message());
    const auto exit = (*process)->wait(kClusterPatience);
    return {exit.value_or(Exit{.code = -1}), (*process)->lines()};
  }

  static constexpr const char* kAnalyze = "/usr/bin/systemd-analyze";
  static constexpr const char* kInstalled = "ExecStart=/usr/bin/";
  const Workbench bench;
};

TEST_F(Units, AreVerifiedBySystemd) {
  for (const char* name : kNames) {
    const auto [exit, lines] = analyze({"verify", bench.folder() / name});
    EXPECT_TRUE(exit.succeeded()) << name << testing::PrintToString(lines);
    EXPECT_THAT(lines, testing::IsEmpty()) << name;
  }
}

TEST_F(Units, AreHardened) {
  for (const char* name : kNames) {
    const auto [exit, lines] = analyze({"security", "--offline=true", "--threshold=40", bench.folder() / name});
    EXPECT_TRUE(exit.succeeded()) << name << ": exposure above 4.0 of 10: " << (lines.empty() ? "" : lines.back());
  }
}

TEST(UnitFiles, RestartWatchAndNotify) {
  for (const char* name : {"lfd-controller.service", "lfd-display.service", "lfd-rendernode@.service"}) {
    const std::string text = *read_file(std::filesystem::path(LFD_SOURCE_DIR) / "configs/systemd" / name);
    EXPECT_THAT(text, AllOf(ContainsRegex("\nType=notify\n"), ContainsRegex("\nRestart=always\n"),
                            ContainsRegex("\nWatchdogSec=[0-9]+\n"), ContainsRegex("\nProtectSystem=strict\n")))
        << name;
  }
}

}  // namespace
}  // namespace lfd::harness
