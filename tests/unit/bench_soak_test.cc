// What a soak judges by: frames of one state, colours that cannot be mistaken, faults that the seed decides.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "bench/soak/faults.h"
#include "bench/soak/frame_checker.h"
#include "bench/soak/soak.h"

namespace lfd::bench {
namespace {

TEST(FrameChecker, NoTwoOfManyColoursAreAlike) {
  std::set<Rgb8> colors;
  for (std::uint64_t n = 0; n < 343; ++n) colors.insert(shown_background_of(n));
  EXPECT_EQ(colors.size(), 343U);
  EXPECT_EQ(shown_background_of(343), shown_background_of(0));
}

class Checker : public testing::Test {
 protected:
  void SetUp() override {
    checker_.background(5, background_of(1));
    checker_.background(8, background_of(2));
    checker_.begun(10, 7);
    checker_.begun(11, 8);
    checker_.swapped(10, {});
    checker_.swapped(11, {3});
  }
  FrameChecker checker_;
};

TEST_F(Checker, AFrameOfItsStateIsRight) {
  const auto verdict = checker_.judge(10, {{0, shown_background_of(1)}, {1, shown_background_of(1)}});
  ASSERT_TRUE(verdict);
  EXPECT_EQ(verdict->fresh, 2);
  EXPECT_EQ(verdict->wrong, 0);
}

TEST_F(Checker, AModuleOfAnotherStateIsWrongUnlessItIsStale) {
  const auto mixed = checker_.judge(11, {{0, shown_background_of(2)}, {1, shown_background_of(1)}});
  ASSERT_TRUE(mixed);
  EXPECT_EQ(mixed->wrong, 1);
  const auto stale = checker_.judge(11, {{0, shown_background_of(2)}, {3, shown_background_of(1)}});
  ASSERT_TRUE(stale);
  EXPECT_EQ(stale->fresh, 1);
  EXPECT_EQ(stale->wrong, 0);
}

TEST_F(Checker, RoundingIsNoOtherColour) {
  Rgb8 color = shown_background_of(2);
  color[1] += 2;
  EXPECT_EQ(checker_.judge(11, {{0, color}})->wrong, 0);
  color[1] += 8;
  EXPECT_EQ(checker_.judge(11, {{0, color}})->wrong, 1);
}

TEST_F(Checker, WhatIsNotKnownIsNotJudged) {
  EXPECT_FALSE(checker_.judge(12, {{0, shown_background_of(2)}}));
  checker_.begun(12, 8);
  EXPECT_FALSE(checker_.judge(12, {{0, shown_background_of(2)}})) << "it has not been swapped";
  checker_.begun(13, 3);
  checker_.swapped(13, {});
  EXPECT_FALSE(checker_.judge(13, {{0, shown_background_of(2)}})) << "nothing was heard of that state";
  checker_.restarted();
  EXPECT_FALSE(checker_.judge(11, {{0, shown_background_of(2)}}));
  EXPECT_FALSE(checker_.last_swapped());
}

TEST(FaultChoice, IsDecidedByTheSeedAndLeavesNoKindOut) {
  FaultChoice one(3), same(3), other(4);
  std::map<Fault, int> seen;
  bool differs = false;
  for (int i = 0; i < 39; ++i) {
    const Fault fault = one.next(true);
    EXPECT_EQ(fault, same.next(true));
    differs = differs || fault != other.next(true);
    EXPECT_LT(fault, Fault::kKillOtherNode);
    ++seen[fault];
  }
  EXPECT_TRUE(differs);
  for (const auto& [fault, times] : seen) EXPECT_EQ(times, 3) << name_of(fault);
  std::set<Fault> harsh;
  for (int i = 0; i < 16; ++i) harsh.insert(one.next(false));
  EXPECT_TRUE(harsh.contains(Fault::kKillController));
  EXPECT_EQ(harsh.size(), 16U);
}

TEST(SoakTable, SaysWhichBoundIsBroken) {
  SoakTable table;
  EXPECT_TRUE(table.verdict().starts_with("passed"));
  table.broken = {"3 frames are mixed", "left has grown by 9.0 MiB"};
  EXPECT_EQ(table.verdict(), "failed: 3 frames are mixed; left has grown by 9.0 MiB");
  const std::string text = text_of(table);
  EXPECT_TRUE(text.ends_with(table.verdict() + "\n"));
}

}  // namespace
}  // namespace lfd::bench
