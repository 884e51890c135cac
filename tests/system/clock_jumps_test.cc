// The time of day set back and forth, and a machine that sleeps: nothing changes, since every process counts by the
// monotonic clock.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>

#include "base/file.h"
#include "base/log.h"
#include "tests/system/fault_stage.h"

namespace lfd::harness {
namespace {

namespace fs = std::filesystem;

// libfaketime, which gives a process another time of day, changed while it runs by a file.
std::optional<fs::path> fake_time_library() {
  for (const char* const folder : {"/usr/lib/x86_64-linux-gnu", "/usr/lib/aarch64-linux-gnu", "/usr/lib"}) {
    const fs::path library = fs::path(folder) / "faketime" / "libfaketimeMT.so.1";
    if (fs::exists(library)) return library;
  }
  return std::nullopt;
}

// The hour and minute at which the process said its last line.
std::string clock_of(const Process& process) {
  const auto lines = process.lines();
  for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
    if (std::smatch match; std::regex_search(*line, match, std::regex("^([0-9]{2}:[0-9]{2}):"))) return match[1];
  }
  return "";
}

TEST(ClockJumps, OfTheTimeOfDayChangeNothing) {
  const auto library = fake_time_library();
  if (!library) GTEST_SKIP() << "libfaketime is not installed (Debian: faketime)";
  FaultStage stage("");
  const fs::path offset = stage.deployment().parent_path() / "offset";
  const auto set = [&](const char* text) {
    ASSERT_TRUE(write_file(offset.string() + ".new", text));
    fs::rename(offset.string() + ".new", offset);
  };
  set("+0\n");
  const FaultStage::Environment fake{{"LD_PRELOAD", library->string()},
                                     {"FAKETIME_TIMESTAMP_FILE", offset},
                                     {"FAKETIME_NO_CACHE", "1"},
                                     {"FAKETIME_DONT_FAKE_MONOTONIC", "1"}};
  for (const char* const name : {"controller", "display", "left", "right"}) stage.start(name, fake);
  ASSERT_TRUE(stage.is_whole());
  const std::string before = clock_of(stage["controller"]);
  for (const char* const jump : {"+7h\n", "-9601h\n", "+175205h\n", "-3h\n"}) {
    set(jump);
    const std::uint64_t frame = stage.last_frame();
    ASSERT_TRUE(stage.shows_frames_after(frame + 10)) << jump;
    EXPECT_NE(clock_of(stage["controller"]), before) << "the time of day has jumped";
  }
  for (const char* const name : {"display", "left", "right"}) {
    EXPECT_FALSE(stage[name].poll()) << name;
    EXPECT_EQ(lines_with(stage["controller"], fmt::format("\"{}\" is out", name)), 0);
    EXPECT_EQ(lines_with(stage[name], "nothing heard"), 0) << name;
  }
  EXPECT_TRUE(stage.is_whole());
}

// As a machine that sleeps and wakes: everybody stops at once for longer than any limit.
TEST(ClockJumps, AMachineThatSleptGoesOn) {
  FaultStage stage("");
  const std::vector<std::string> names{"controller", "display", "left", "right"};
  for (const auto& name : names) stage.start(name);
  ASSERT_TRUE(stage.is_whole());
  const auto before = stage.pictures_from(stage.last_frame());
  for (const auto& name : names) stage[name].signal(SIGSTOP);
  EXPECT_FALSE(stage["left"].wait(std::chrono::milliseconds(1500)));  // the limit is 600 ms
  for (const auto& name : names) stage[name].signal(SIGCONT);
  const std::uint64_t woken = stage.last_frame();
  ASSERT_TRUE(stage.shows_frames_after(woken + 3));
  ASSERT_TRUE(stage.is_whole());
  EXPECT_EQ(stage.pictures_from(stage.last_frame()), before);
}

// Only stamps that people read know the time of day: those of the log, which its library makes, and of faults.
TEST(ClockJumps, NoSourceAsksForTheTimeOfDay) {
  const std::regex forbidden("system_clock|CLOCK_REALTIME|gettimeofday|[^_a-z]time\\((nullptr|NULL|0)\\)");
  for (const char* const folder : {"base", "calibration", "proto", "controller", "rendernode", "display", "cli"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(LFD_SOURCE_DIR) / folder)) {
      if (entry.path().extension() != ".cc" && entry.path().extension() != ".h") continue;
      const auto text = read_file(entry.path());
      ASSERT_TRUE(text);
      const bool stamps = entry.path().filename() == "time_of_day.cc";
      EXPECT_EQ(std::regex_search(*text, forbidden), stamps) << entry.path();
    }
  }
}

}  // namespace
}  // namespace lfd::harness
