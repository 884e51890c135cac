// lfd ctl status --watch: tables that keep coming, in a pipe and in a terminal, whatever becomes of the controller.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/log.h"
#include "tests/system/running_cluster.h"

namespace lfd::harness {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ContainsRegex;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

std::vector<std::string> watch_command(const std::string& endpoint) {
  return {"ctl", "status", "--watch", "--every", "0.1", "--controller", endpoint};
}

TEST(LfdWatch, GoesOnWhileTheControllerIsAwayAndAfterItCameBack) {
  const Workbench bench;
  const auto deployment = bench.deployment(fmt::format("addresses {{ control: \"tcp://127.0.0.1:{}\" }}", free_port()));
  auto controller = start_controller(deployment);
  const auto watch = start_program("lfd", watch_command(controller.endpoint));
  ASSERT_TRUE(says(*watch, "wall: plane", 3)) << testing::PrintToString(watch->lines());
  controller.process->signal(SIGKILL);
  ASSERT_TRUE(says(*watch, "the controller does not answer")) << testing::PrintToString(watch->lines());
  EXPECT_FALSE(watch->poll());
  controller.process->wait(kClusterPatience);
  controller = start_controller(deployment);
  ASSERT_TRUE(says(*watch, "the controller was started anew, after ")) << testing::PrintToString(watch->lines());
  const auto tables = lines_with(*watch, "wall: ");
  EXPECT_TRUE(says(*watch, "wall: ", tables + 2));
  watch->signal(SIGINT);
  const auto exit = watch->wait(kClusterPatience);
  ASSERT_TRUE(exit);
  EXPECT_TRUE(exit->succeeded()) << exit->text();
  for (const std::string& line : watch->lines()) EXPECT_THAT(line, Not(HasSubstr("\x1b"))) << "this is no terminal";
}

TEST(LfdWatch, WaitsForAControllerThatIsNotThereYet) {
  const Workbench bench;
  const int port = free_port();
  const auto watch = start_program("lfd", watch_command(fmt::format("tcp://127.0.0.1:{}", port)));
  ASSERT_TRUE(says(*watch, "the controller does not answer")) << testing::PrintToString(watch->lines());
  const auto controller =
      start_controller(bench.deployment(fmt::format("addresses {{ control: \"tcp://127.0.0.1:{}\" }}", port)));
  EXPECT_TRUE(says(*watch, "the controller answers again, after ")) << testing::PrintToString(watch->lines());
}

TEST(LfdWatch, TellsOfANodeThatDied) {
  const Workbench bench;
  const Running running = run_cluster(bench.deployment("pacing { heartbeat_ms: 100 }"));
  ASSERT_TRUE(draws(running.endpoint, 1));
  const proto::Status status = *status_at(running.endpoint);
  EXPECT_EQ(status.last_fault(), "");
  EXPECT_GT(status.begin_to_swap_ms(), 0);
  EXPECT_GT(status.published_bytes(), 0u);
  EXPECT_TRUE(becomes(running.endpoint, [](const proto::Status& s) {
    return peer_in(s, "left").frames_per_second() > 0 && peer_in(s, "left").begin_to_ready_ms() > 0 &&
           peer_in(s, "left").pass_size() > 0 && s.shown_frames() > 0 && peer_in(s, "display").frames_per_second() > 0;
  }));
  ::kill(static_cast<pid_t>(peer_in(status, "left").process()), SIGSTOP);  // `lfd run` would end with one that died
  EXPECT_TRUE(
      becomes(running.endpoint, [](const proto::Status& s) { return !peer_in(s, "left").last_fault().empty(); }));
  const proto::Status after = *status_at(running.endpoint);
  EXPECT_THAT(peer_in(after, "left").last_fault(), EndsWith("out: it was silent for too long"));
  EXPECT_THAT(after.last_fault(), HasSubstr("\"left\": out: "));
  EXPECT_EQ(peer_in(after, "right").last_fault(), "");
  ::kill(static_cast<pid_t>(peer_in(status, "left").process()), SIGCONT);
}

TEST(LfdWatch, TellsWhatNodesDrawWithUnderABudget) {
  const Workbench bench;
  const Running running = run_cluster(bench.deployment("pacing { heartbeat_ms: 100 }"));
  ASSERT_TRUE(draws(running.endpoint, 1));
  EXPECT_THAT(ctl(running, {"ao", "--budget", "1000"}), IsEmpty());
  ASSERT_TRUE(becomes(running.endpoint, [](const proto::Status& s) {
    return !peer_in(s, "left").occlusion_choice().empty() && !peer_in(s, "right").occlusion_choice().empty();
  }));
  const std::string choice = peer_in(*status_at(running.endpoint), "left").occlusion_choice();
  EXPECT_THAT(choice, HasSubstr(" ms of 1000 ms"));
  EXPECT_THAT(ctl(running, {"ao"}), AllOf(Contains("occlusion of \"left\": " + choice),
                                          Contains("samples    every node's own choice, seed 0")));
  EXPECT_THAT(ctl(running, {"status"}), Contains("occlusion of \"left\": " + choice));
  ctl(running, {"ao", "--budget", "0"});
  EXPECT_TRUE(
      becomes(running.endpoint, [](const proto::Status& s) { return peer_in(s, "left").occlusion_choice().empty(); }));
}

// Reads from a terminal's other side until `text` has come `times` times or nothing more can.
std::string read_until(int terminal, const std::string& text, int times) {
  std::string all;
  const auto count = [&] {
    int found = 0;
    for (auto at = all.find(text); at != all.npos; at = all.find(text, at + 1)) ++found;
    return found;
  };
  const auto deadline = Clock::now() + kClusterPatience;
  while (count() < times && Clock::now() < deadline) {
    pollfd ready{.fd = terminal, .events = POLLIN, .revents = 0};
    if (::poll(&ready, 1, 1000) <= 0) continue;
    char bytes[4096];
    const ssize_t got = ::read(terminal, bytes, sizeof bytes);
    if (got <= 0) break;  // the program has closed its side
    all.append(bytes, static_cast<std::size_t>(got));
  }
  return all;
}

TEST(LfdWatch, DrawsInPlaceOnATerminalAndGivesItsScreenAndCursorBack) {
  const Workbench bench;
  const auto controller = start_controller(bench.deployment(""));
  winsize size{.ws_row = 8, .ws_col = 40, .ws_xpixel = 0, .ws_ypixel = 0};
  int terminal = -1;
  const pid_t child = ::forkpty(&terminal, nullptr, nullptr, &size);
  ASSERT_GE(child, 0);
  if (child == 0) {
    std::vector<std::string> command = watch_command(controller.endpoint);
    command.insert(command.begin(), LFD_BIN_DIR "/lfd");
    std::vector<char*> words;
    for (std::string& word : command) words.push_back(word.data());
    words.push_back(nullptr);
    ::execv(words[0], words.data());
    ::_exit(127);
  }
  const std::string drawn = read_until(terminal, "\x1b[H", 3);
  EXPECT_THAT(drawn, StartsWith("\x1b[?1049h\x1b[?25l\x1b[Hwall: plane"));
  EXPECT_THAT(drawn, Not(HasSubstr("\x1b[?25h")));
  ASSERT_EQ(::write(terminal, "\x03", 1), 1) << "Ctrl-C";
  const std::string rest = read_until(terminal, "nothing says this", 1);
  EXPECT_THAT(rest, ContainsRegex("\x1b\\[\\?25h\x1b\\[\\?1049lwall: plane"));
  EXPECT_THAT(rest.substr(rest.rfind("\x1b")), AllOf(HasSubstr("last fault: none"), HasSubstr("stages, ms")))
      << "the last table stays, whole";
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  ::close(terminal);
  // A line is cut to 40 columns.
  const std::string last = drawn.substr(0, drawn.rfind("\x1b[H"));
  EXPECT_THAT(last, Not(HasSubstr("modules    fps"))) << last;
}

TEST(LfdWatch, EveryNeedsWatch) {
  const auto lfd = start_program("lfd", {"ctl", "status", "--every", "2"});
  const auto exit = lfd->wait(kClusterPatience);
  ASSERT_TRUE(exit);
  EXPECT_EQ(exit->code, 2);
}

}  // namespace
}  // namespace lfd::harness
