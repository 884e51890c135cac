// Pacing: free running, paced, and by request.
#include "controller/pacing.h"

#include <gtest/gtest.h>

namespace lfd::controller {
namespace {

using namespace std::chrono_literals;

const Clock::time_point kStart{};

TEST(Pacing, RunsFreelyWithoutARate) {
  Pacing pacing(0, false);
  EXPECT_TRUE(pacing.due(kStart));
  pacing.begun(kStart);
  EXPECT_TRUE(pacing.due(kStart));
  EXPECT_FALSE(pacing.next());
}

TEST(Pacing, KeepsTheRate) {
  Pacing pacing(100, false);
  EXPECT_TRUE(pacing.due(kStart));
  pacing.begun(kStart);
  EXPECT_FALSE(pacing.due(kStart + 9ms));
  EXPECT_EQ(pacing.next(), kStart + 10ms);
  EXPECT_TRUE(pacing.due(kStart + 12ms));
  pacing.begun(kStart + 12ms);
  EXPECT_EQ(pacing.next(), kStart + 20ms);
}

TEST(Pacing, DoesNotMakeUpForFramesThatTookTooLong) {
  Pacing pacing(100, false);
  pacing.begun(kStart);
  pacing.begun(kStart + 1s);
  EXPECT_EQ(pacing.next(), kStart + 1s);
  pacing.begun(kStart + 1s);
  EXPECT_EQ(pacing.next(), kStart + 1s + 10ms);
}

TEST(Pacing, RestsUntilAskedAndAfterwards) {
  Pacing pacing(100, true);
  EXPECT_FALSE(pacing.wants_frames());
  pacing.ask_for(2);
  EXPECT_TRUE(pacing.due(kStart));
  pacing.begun(kStart);
  EXPECT_TRUE(pacing.due(kStart));
  pacing.begun(kStart);
  EXPECT_FALSE(pacing.wants_frames());
  EXPECT_FALSE(pacing.due(kStart + 1h));
}

}  // namespace
}  // namespace lfd::controller
