// Which connection speaks for a node at the display.
#include "display/senders.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/log.h"

namespace lfd::display {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

const Clock::time_point kStart{};

TEST(Senders, TheFirstSpeaksAndGreetingsAreRepeatedAtWill) {
  Senders senders({"left", "right"}, false);
  const auto first = senders.hello("A", "", "left", kStart);
  ASSERT_TRUE(first);
  EXPECT_TRUE(first->is_new);
  EXPECT_FALSE(first->replaced);
  EXPECT_FALSE(senders.hello("A", "", "left", kStart)->is_new);
  EXPECT_EQ(senders.speaks_for("left"), "A");
  EXPECT_FALSE(senders.speaks_for("right"));
}

TEST(Senders, NobodyElseSpeaksForANodeWhoseConnectionIsThere) {
  Senders senders({"left", "right"}, false);
  ASSERT_TRUE(senders.hello("A", "", "left", kStart));
  EXPECT_THAT(senders.hello("B", "", "left", kStart + 1h).error().message(), HasSubstr("another connection"));
  EXPECT_EQ(senders.speaks_for("left"), "A");
  senders.left("A");
  EXPECT_TRUE(senders.hello("B", "", "left", kStart + 1h)->is_new);
}

TEST(Senders, AcrossMachinesASilentConnectionMayBeDead) {
  Senders senders({"left"}, true);
  ASSERT_TRUE(senders.hello("A", "", "left", kStart));
  senders.heard("A", kStart + 2s);
  EXPECT_FALSE(senders.hello("B", "", "left", kStart + 4s));
  const auto later = senders.hello("B", "", "left", kStart + 5s);
  ASSERT_TRUE(later);
  EXPECT_EQ(later->replaced, "A");
  EXPECT_EQ(senders.speaks_for("left"), "B");
}

TEST(Senders, ANodesOwnKeySpeaksForItAtOnceAndNoOtherEver) {
  Senders senders({"left", "right"}, false);
  ASSERT_TRUE(senders.hello("A", "left", "left", kStart));
  EXPECT_EQ(senders.hello("B", "left", "left", kStart)->replaced, "A");
  EXPECT_THAT(senders.hello("C", "right", "left", kStart + 1h).error().message(),
              HasSubstr("the key of \"right\" speaks for no other node"));
}

TEST(Senders, AConnectionIsThatOfTheKeyThatGreetedThere) {
  Senders senders({"left", "right"}, false);
  ASSERT_TRUE(senders.hello("A", "left", "left", kStart));
  EXPECT_FALSE(senders.is_borrowed("A", "left"));
  EXPECT_TRUE(senders.is_borrowed("A", "right"));
  EXPECT_FALSE(senders.is_borrowed("B", "right"));
  ASSERT_TRUE(senders.hello("B", "left", "left", kStart));  // it has a new connection
  EXPECT_FALSE(senders.is_borrowed("A", "right"));
}

TEST(Senders, OnlyNodesOfTheDeploymentSpeak) {
  Senders senders({"left"}, false);
  EXPECT_FALSE(senders.hello("A", "", "middle", kStart));
  EXPECT_TRUE(senders.peers().empty());
}

TEST(Senders, WithoutADeploymentTheirNumberIsBounded) {
  Senders senders({}, false);
  std::size_t taken = 0;
  for (int i = 0; i < 5000; ++i)
    taken += senders.hello(fmt::format("{}", i), "", fmt::format("n{}", i), kStart) ? 1 : 0;
  EXPECT_EQ(taken, Senders::kMost);
}

}  // namespace
}  // namespace lfd::display
