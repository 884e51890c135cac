// The mailbox between two threads: order, bound, bell.
#include "proto/wire/mailbox.h"

#include <gtest/gtest.h>

#include <memory>
#include <thread>

#include "proto/wire/poll.h"

namespace lfd::wire {
namespace {

using namespace std::chrono_literals;

TEST(WireMailbox, KeepsOrderAcrossThreadsWhileTheReceiverWaitsOnItsDescriptor) {
  Mailbox<int> mailbox(8);
  constexpr int kCount = 20000;
  std::jthread sender([&] {
    for (int i = 0; i < kCount; ++i) {
      while (!mailbox.put(int{i})) std::this_thread::yield();
    }
  });
  for (int expected = 0; expected < kCount;) {
    ASSERT_TRUE(wait({}, {mailbox.descriptor()}, 30s));
    while (const auto item = mailbox.take()) ASSERT_EQ(*item, expected++);
  }
  EXPECT_FALSE(wait({}, {mailbox.descriptor()}, 0s));
}

TEST(WireMailbox, RefusesWhatItCannotHoldAndLeavesItToTheSender) {
  Mailbox<std::unique_ptr<int>> mailbox(1);
  EXPECT_TRUE(mailbox.put(std::make_unique<int>(1)));
  auto second = std::make_unique<int>(2);
  EXPECT_FALSE(mailbox.put(std::move(second)));
  ASSERT_NE(second, nullptr);  // NOLINT(bugprone-use-after-move): that is what is tested
  EXPECT_EQ(**mailbox.take(), 1);
  EXPECT_TRUE(mailbox.put(std::move(second)));
}

TEST(WireMailbox, CloseWakesWhoWaitsAndLetsTheRestBeTaken) {
  Mailbox<int> mailbox(4);
  EXPECT_TRUE(mailbox.put(7));
  mailbox.close();
  EXPECT_FALSE(mailbox.put(8));
  EXPECT_EQ(mailbox.take_within(30s), 7);
  EXPECT_EQ(mailbox.take_within(30s), std::nullopt);
  EXPECT_TRUE(wait({}, {mailbox.descriptor()}, 0s));
}

}  // namespace
}  // namespace lfd::wire
