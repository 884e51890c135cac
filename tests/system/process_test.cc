// Child processes: their lines, their ends, and that none is left behind.
#include "base/process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

namespace lfd {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;

std::unique_ptr<Process> shell(const std::string& script) {
  auto process = Process::start(
      {.name = "shell", .command = {"/bin/sh", "-c", script}, .on_line = {}, .environment = {{"WORD", "x y"}}});
  EXPECT_TRUE(process);
  return *std::move(process);
}

TEST(Process, GivesLinesOfBothStreamsAndTheExitCode) {
  const auto process = shell("echo one; echo two >&2; printf \"$WORD\"; exit 3");
  EXPECT_EQ(process->wait(10s), (Exit{.code = 3, .signal = 0}));
  EXPECT_EQ(process->wait_for_line("x", 10s), "x y");
  EXPECT_THAT(process->lines(), ElementsAre("one", "two", "x y"));
}

TEST(Process, HasItsLastWordsOnceItHasEnded) {
  for (int i = 0; i < 50; ++i) {
    const auto process = shell("echo last words");
    ASSERT_TRUE(process->wait(10s));
    ASSERT_THAT(process->lines(), ElementsAre("last words")) << "run " << i;
  }
}

TEST(Process, DoesNotWaitForAGrandchildThatGoesOnTalking) {
  const auto process = shell("(for i in 1 2 3 4 5 6 7 8 9; do echo $i; sleep 1; done) & exit 0");
  EXPECT_TRUE(process->wait(10s)->succeeded());
  EXPECT_THAT(process->lines().size(), testing::Lt(5U)) << "nine seconds have not passed";
}

TEST(Process, WaitsForLinesInTheirOrder) {
  const auto process = shell("echo a1; echo a2; sleep 100");
  EXPECT_EQ(process->wait_for_line("a", 10s), "a1");
  EXPECT_EQ(process->wait_for_line("a", 10s), "a2");
  EXPECT_EQ(process->wait_for_line("a", 10ms), std::nullopt);
}

TEST(Process, StopsPolitelyAndOtherwiseForSure) {
  const auto polite = shell("trap 'exit 0' TERM; echo up; while true; do sleep 0.01; done");
  ASSERT_TRUE(polite->wait_for_line("up", 10s));
  EXPECT_TRUE(polite->stop(10s).succeeded());
  const auto stubborn = shell("trap '' TERM; echo up; while true; do sleep 0.01; done");
  ASSERT_TRUE(stubborn->wait_for_line("up", 10s));
  EXPECT_EQ(stubborn->stop(50ms).signal, SIGKILL);
}

TEST(Process, NamesTheProgramThatCannotBeStarted) {
  const auto process = Process::start({.name = "", .command = {"/nowhere/program"}, .on_line = {}, .environment = {}});
  ASSERT_FALSE(process);
  EXPECT_THAT(process.error().message(), HasSubstr("/nowhere/program: cannot be started: No such file"));
}

TEST(Process, LeavesNoChildBehind) {
  pid_t id = 0;
  {
    const auto process = shell("sleep 100");
    id = process->id();
  }
  EXPECT_EQ(::kill(id, 0), -1);
}

}  // namespace
}  // namespace lfd
