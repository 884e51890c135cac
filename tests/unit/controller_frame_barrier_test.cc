// The frame barrier: order, limit, deadline and death of nodes, also under random orders of events.
#include "controller/frame_barrier.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <random>

namespace lfd::controller {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

const Clock::time_point kStart{};

TEST(FrameBarrier, LetsTheNextFrameBeginWhenAllHaveDrawn) {
  FrameBarrier barrier(0ms);
  const std::uint64_t frame = barrier.begin({"left", "right"}, kStart);
  barrier.drawn("left", frame);
  EXPECT_FALSE(barrier.may_begin());
  barrier.drawn("right", frame);
  EXPECT_TRUE(barrier.may_begin());
}

TEST(FrameBarrier, HoldsTwoFramesAtMost) {
  FrameBarrier barrier(0ms);
  barrier.drawn("left", barrier.begin({"left"}, kStart));
  barrier.drawn("left", barrier.begin({"left"}, kStart));
  EXPECT_FALSE(barrier.may_begin());
  barrier.ready("left", 0);
  ASSERT_TRUE(barrier.swap(kStart));
  EXPECT_TRUE(barrier.may_begin());
}

TEST(FrameBarrier, SwapsWhenAllAreReady) {
  FrameBarrier barrier(0ms);
  barrier.begin({"left", "right"}, kStart);
  barrier.ready("right", 0);
  EXPECT_FALSE(barrier.swap(kStart + 1h));
  barrier.ready("left", 0);
  const auto swap = barrier.swap(kStart + 1h);
  ASSERT_TRUE(swap);
  EXPECT_THAT(swap->ready, UnorderedElementsAre("left", "right"));
  EXPECT_THAT(swap->missing, IsEmpty());
  EXPECT_FALSE(swap->late);
}

TEST(FrameBarrier, SwapsInOrderThoughTheLaterFrameIsReadyFirst) {
  FrameBarrier barrier(0ms);
  barrier.begin({"left"}, kStart);
  barrier.drawn("left", 0);
  barrier.begin({"left"}, kStart);
  barrier.ready("left", 1);
  EXPECT_FALSE(barrier.swap(kStart));
  barrier.ready("left", 0);
  EXPECT_EQ(barrier.swap(kStart)->frame, 0u);
  EXPECT_EQ(barrier.swap(kStart)->frame, 1u);
  EXPECT_FALSE(barrier.swap(kStart));
}

TEST(FrameBarrier, SwapsWithoutTheSlowAtTheDeadline) {
  FrameBarrier barrier(8ms);
  barrier.begin({"left", "right"}, kStart);
  barrier.ready("right", 0);
  EXPECT_EQ(barrier.next_deadline(), kStart + 8ms);
  EXPECT_FALSE(barrier.swap(kStart + 7ms));
  const auto swap = barrier.swap(kStart + 8ms);
  ASSERT_TRUE(swap);
  EXPECT_TRUE(swap->late);
  EXPECT_THAT(swap->ready, ElementsAre("right"));
  EXPECT_THAT(swap->missing, ElementsAre("left"));
  EXPECT_TRUE(barrier.may_begin());
  EXPECT_FALSE(barrier.next_deadline());
}

TEST(FrameBarrier, IgnoresWhatConcernsNoOpenFrame) {
  FrameBarrier barrier(8ms);
  barrier.begin({"left"}, kStart);
  ASSERT_TRUE(barrier.swap(kStart + 9ms));
  barrier.begin({"left"}, kStart + 9ms);
  barrier.ready("left", 0);
  barrier.drawn("left", 7);
  barrier.ready("stranger", 1);
  EXPECT_FALSE(barrier.may_begin());
  EXPECT_FALSE(barrier.swap(kStart + 10ms));
}

TEST(FrameBarrier, IsReleasedByANodeThatDies) {
  FrameBarrier barrier(0ms);
  barrier.begin({"left", "right"}, kStart);
  barrier.ready("left", 0);
  barrier.gone("right");
  const auto swap = barrier.swap(kStart);
  ASSERT_TRUE(swap);
  EXPECT_THAT(swap->missing, ElementsAre("right"));
  EXPECT_FALSE(swap->late);
}

// Whatever order the events come in: never more than two open, swaps in order and each frame once, and everything ends.
TEST(FrameBarrier, KeepsItsPromisesUnderRandomEvents) {
  const std::vector<std::string> names{"a", "b", "c", "d"};
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    const auto chance = [&](unsigned percent) { return random() % 100 < percent; };
    const bool has_deadline = chance(50);
    FrameBarrier barrier(has_deadline ? Clock::duration(20ms) : Clock::duration::zero());
    Clock::time_point now = kStart;
    std::uint64_t begun = 0, swapped = 0;
    std::map<std::string, std::vector<std::uint64_t>> owed;  // frames a node has still to be ready for
    for (int step = 0; step < 3000 && swapped < 200; ++step) {
      now += std::chrono::milliseconds(random() % 3);
      if (begun < 200 && barrier.may_begin() && chance(60)) {
        ASSERT_EQ(barrier.begin(names, now), begun++);
        for (const std::string& name : names) owed[name].push_back(begun - 1);
      }
      const std::string& node = names[random() % names.size()];
      if (!owed[node].empty()) {
        const std::size_t which = random() % owed[node].size();
        const std::uint64_t frame = owed[node][which];
        if (chance(40)) barrier.drawn(node, frame);
        if (chance(60)) {
          barrier.ready(node, frame);
          owed[node].erase(owed[node].begin() + static_cast<std::ptrdiff_t>(which));
        }
        if (chance(2)) {
          barrier.gone(node);
          owed[node].clear();
        }
      }
      while (const auto swap = barrier.swap(now)) {
        ASSERT_EQ(swap->frame, swapped++);
        ASSERT_EQ(swap->ready.size() + swap->missing.size(), names.size());
        if (swap->late) {
          ASSERT_TRUE(has_deadline);
        }
      }
      ASSERT_LE(barrier.in_flight(), FrameBarrier::kInFlight);
      ASSERT_EQ(begun - swapped, barrier.in_flight());
    }
    for (const std::string& name : names) barrier.gone(name);
    while (barrier.swap(now)) ++swapped;
    EXPECT_EQ(swapped, begun) << "seed " << seed;
    EXPECT_GT(swapped, 20u) << "seed " << seed;
  }
}

TEST(FrameBarrier, TellsWhoIsWaitedForSinceWhen) {
  FrameBarrier barrier(0ms);
  barrier.begin({"left", "right"}, kStart);
  barrier.drawn("left", 0);
  barrier.drawn("right", 0);
  barrier.ready("left", 0);
  barrier.begin({"left", "right"}, kStart + 100ms);
  EXPECT_TRUE(barrier.waiting_since(kStart - 1ms).empty());
  const auto first = barrier.waiting_since(kStart);
  ASSERT_EQ(first.size(), 1U);
  EXPECT_EQ(first[0].frame, 0U);
  EXPECT_EQ(first[0].nodes, std::vector<std::string>{"right"});
  EXPECT_EQ(barrier.waiting_since(kStart + 100ms).size(), 2U);
  barrier.gone("right");
  EXPECT_EQ(barrier.waiting_since(kStart + 100ms).size(), 1U) << "nobody is waited for in the first";
}

}  // namespace
}  // namespace lfd::controller
