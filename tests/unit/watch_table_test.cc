// The live table of `lfd ctl status --watch`, and what is made of text before it reaches a terminal.
#include "cli/watch_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/printable.h"
#include "cli/status_table.h"
#include "cli/terminal.h"

namespace lfd {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const Clock::time_point kStart{};

proto::Status two_peers(std::uint64_t bytes, double up_s) {
  proto::Status status;
  status.set_deployment("wall");
  status.set_scene("room");
  status.set_frame(123);
  status.set_frames_per_second(59.94);
  status.set_module_count(8);
  status.set_stale_modules(2);
  status.set_late_frames(5);
  status.set_state_hash("0123456789abcdef");
  status.set_begin_to_swap_ms(12.34);
  status.set_last_fault("2026-05-01 14:03:12 \"left\": out: it was silent for too long");
  status.set_up_s(up_s);
  proto::PeerStatus& left = *status.add_peer();
  left.set_name("left");
  left.set_state("late");
  for (const std::uint32_t module : {0, 1, 2, 5}) left.add_module(module);
  left.set_image_bytes(bytes);
  left.set_begin_to_ready_ms(10.25);
  left.set_stale_modules(2);
  left.set_last_fault("2026-05-01 14:03:12 out: it was silent for too long");
  for (const auto& [name, ms] :
       {std::pair("geometry", 0.5), {"gbuffer", 2.0}, {"ao", 3.0}, {"ao", 4.0}, {"post", 1.0}}) {
    proto::PassTime& pass = *left.add_pass();
    pass.set_pass(name);
    (pass.pass() == "geometry" ? pass.set_cpu_ms(ms) : pass.set_gpu_ms(ms));
  }
  proto::PeerStatus& spare = *status.add_peer();
  spare.set_name("reserve");
  spare.set_state("ready");
  spare.set_spare(true);
  return status;
}

// The first line that begins with `name`.
std::string line_of(const std::string& text, const std::string& name) {
  const std::size_t begin = text.starts_with(name) ? 0 : text.find("\n" + name) + 1;
  return begin == 0 && !text.starts_with(name) ? "" : text.substr(begin, text.find('\n', begin) - begin);
}

TEST(WatchTable, SaysWhatAPersonAsksFor) {
  WatchTable table;
  table.answered(two_peers(1'000'000, 10), kStart);
  const std::string text = table.answered(two_peers(5'000'000, 12), kStart + 2s);
  EXPECT_THAT(text, StartsWith("wall: room, up 12 s\n"));
  EXPECT_THAT(text, HasSubstr("frame 123, 59.9 fps, 5 late, 2 of 8 modules stale\n"));
  EXPECT_THAT(text, HasSubstr("begin to swap 12.3 ms, to shown - ms, state 01234567 (update 0)\n"));
  EXPECT_THAT(text, HasSubstr("last fault: 2026-05-01 14:03:12 \"left\": out"));
  EXPECT_THAT(line_of(text, "left"), AllOf(HasSubstr(" late "), HasSubstr(" 0-2,5 "), HasSubstr(" 10.2 "),
                                           HasSubstr(" 2.0 MB "), HasSubstr("ao 7.0, gbuffer 2.0, post 1.0")));
  EXPECT_THAT(line_of(text, "reserve"), HasSubstr(" spare "));
  EXPECT_THAT(text, HasSubstr("last fault of \"left\": 2026-05-01 14:03:12 out"));
}

TEST(WatchTable, FitsIntoATerminalOfEightyColumns) {
  WatchTable table;
  const std::string text = table.answered(two_peers(0, 1), kStart);
  EXPECT_LE(text.find("stages, ms") - text.find("peer "), 70u);
}

TEST(WatchTable, KnowsNoRateAtFirstNorAfterARestart) {
  WatchTable table;
  EXPECT_THAT(line_of(table.answered(two_peers(1'000'000, 10), kStart), "left"), Not(HasSubstr("B ")));
  const std::string anew = table.answered(two_peers(2'000'000, 1), kStart + 1s);
  EXPECT_THAT(anew, StartsWith("the controller was started anew\n"));
  EXPECT_THAT(line_of(anew, "left"), Not(HasSubstr("B ")));
  EXPECT_THAT(line_of(table.answered(two_peers(2'500'000, 2), kStart + 2s), "left"), HasSubstr(" 500.0 kB "));
}

TEST(WatchTable, SaysThatTheControllerIsAwayAndThatItIsBack) {
  WatchTable table;
  EXPECT_EQ(table.unanswered(kStart, true), "the controller does not answer; waiting for it\n");
  EXPECT_THAT(table.answered(two_peers(0, 10), kStart + 3s), StartsWith("the controller answers again, after 3 s\n"));
  EXPECT_THAT(table.answered(two_peers(0, 11), kStart + 4s), StartsWith("wall: room"));
  table.unanswered(kStart + 5s, true);
  EXPECT_THAT(table.unanswered(kStart + 9s, true),
              AllOf(StartsWith("the controller does not answer, for 4 s"), HasSubstr("it said last:\nwall: room")));
  EXPECT_THAT(table.unanswered(kStart + 9s, false), Not(HasSubstr("wall")));
  EXPECT_THAT(table.answered(two_peers(0, 1), kStart + 10s),
              StartsWith("the controller was started anew, after 5 s\nwall"));
}

TEST(WatchTable, ShowsWhatNodesChoseUnderABudget) {
  proto::Status status = two_peers(0, 1);
  status.mutable_peer(0)->set_occlusion_choice("gtao, 3 slices: 1.2 ms of 2 ms");
  const std::string line = "occlusion of \"left\": gtao, 3 slices: 1.2 ms of 2 ms\n";
  EXPECT_EQ(choices_text(status), line);
  EXPECT_THAT(WatchTable().answered(status, kStart), HasSubstr(line));
  EXPECT_THAT(status_table(status), HasSubstr(line));
}

TEST(StatusTable, HasTheFiguresOfEveryPeer) {
  const std::string text = status_table(two_peers(5'000'000, 12.4));
  EXPECT_THAT(text, HasSubstr("ao 7.0, gbuffer 2.0, post 1.0, geometry 0.5\n"));
  EXPECT_THAT(text, HasSubstr(" 5000000 "));
  EXPECT_THAT(text, HasSubstr("last fault of \"left\": 2026"));
  EXPECT_THAT(line_of(text, "up"), HasSubstr(" 12 s"));
  EXPECT_THAT(line_of(text, "begin to swap"), HasSubstr(" 12.3 ms"));
  EXPECT_THAT(line_of(text, "reserve"), HasSubstr(" spare "));
}

TEST(AoText, SaysUnderABudgetOnlyWhatIsNotTheNodesChoice) {
  proto::AmbientOcclusion ao;
  EXPECT_THAT(ao_text(ao), AllOf(HasSubstr("samples    "), Not(HasSubstr("choice"))));
  ao.set_budget_ms(2);
  std::string text = ao_text(ao);
  for (const char* line : {"samples    every node's own choice, seed 0\n", "curve      every node's own choice\n",
                           "blur       every node's own choice\n", "shared     every node's own choice\n",
                           "as many radii as every node chooses\n"})
    EXPECT_THAT(text, HasSubstr(line));
  ao.mutable_curve()->set_b(2);
  ao.mutable_curve()->set_c(1);
  ao.mutable_shared()->set_neighbours(2);
  ao.set_radii(3);
  text = ao_text(ao);
  EXPECT_THAT(text, AllOf(HasSubstr("b 2, "), HasSubstr("over +-2 modules"), HasSubstr(" 3 radii")));
}

TEST(Terminal, ForeignTextCannotControlIt) {
  EXPECT_EQ(printable_lines("one\x1b\n12:00:00 W [left] two\n"), "one?\n  | 12:00:00 W [left] two\n  | ");
  EXPECT_EQ(printable("caf\xc3\xa9 \x1b[2J\n\x7f"), "caf\xc3\xa9 ?[2J??");
  EXPECT_EQ(printable("\xc2\x9b"
                      "2J \xc2\xa0"),
            "?2J \xc2\xa0");
  proto::Status status = two_peers(0, 1);
  status.mutable_peer(0)->set_name("le\x1b[31mft");
  status.mutable_peer(0)->set_last_fault("\x1b]0;title\x07");
  status.set_last_fault("\x1b[2J");
  EXPECT_THAT(WatchTable().answered(status, kStart), Not(HasSubstr("\x1b")));
  EXPECT_THAT(status_table(status), Not(HasSubstr("\x1b")));
}

TEST(Terminal, TextIsCutToItsSize) {
  EXPECT_EQ(cut_to("abcdef\nab\nabc\n", 3, 2), "abc\nab\n");
  EXPECT_EQ(cut_to("\xc3\xa9\xc3\xa9\xc3\xa9x\n", 2, 9), "\xc3\xa9\xc3\xa9\n");
}

}  // namespace
}  // namespace lfd
