// What a peer makes of a refusal: now, later or never.
#include "proto/refusal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/unwrapped.h"

namespace lfd {
namespace {

using namespace std::chrono_literals;
using testing_support::unwrapped;

proto::Refused refused(std::uint32_t try_again_ms, bool not_a_member) {
  proto::Refused message;
  message.set_reason("the reason");
  message.set_try_again_ms(try_again_ms);
  message.set_not_a_member(not_a_member);
  return message;
}

class Refused : public testing::Test {
 protected:
  Result<bool> hears(const proto::Refused& message, bool is_member) {
    return refusals_.heard(message, is_member, "tcp://there:1", next_join_);
  }
  // From now on; of what was put off before this call.
  Clock::duration put_off() const { return next_join_ - Clock::now(); }

  Refusals refusals_;
  Clock::time_point next_join_ = Clock::now();
};

TEST_F(Refused, AMemberThatIsNoneAnyMoreJoinsAgain) { EXPECT_TRUE(unwrapped(hears(refused(0, true), true))); }

TEST_F(Refused, OneThatHasAskedToJoinByNowGoesOnWaiting) {
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(unwrapped(hears(refused(0, true), false)));
  }
  EXPECT_LE(put_off(), 0ms);
}

TEST_F(Refused, OneThatIsToTryAgainDoesSoLater) {
  EXPECT_FALSE(unwrapped(hears(refused(5000, false), false)));
  EXPECT_GT(put_off(), 3s);
  EXPECT_LE(put_off(), 5s);
}

TEST_F(Refused, NobodyIsPutOffForLongerThanTenSeconds) {
  ASSERT_TRUE(hears(refused(4'000'000'000U, false), false));
  EXPECT_GT(put_off(), 8s);
  EXPECT_LE(put_off(), 10s);
}

// Of a join that the controller has answered twice.
TEST_F(Refused, AMemberThatIsToTryAgainStaysOne) {
  EXPECT_FALSE(unwrapped(hears(refused(5000, false), true)));
  EXPECT_LE(put_off(), 0ms);
}

TEST_F(Refused, ForGoodIsAnErrorThatNamesTheController) {
  const auto joins = hears(refused(0, false), false);
  ASSERT_FALSE(joins);
  EXPECT_EQ(joins.error().message(), "tcp://there:1: refused: the reason");
}

TEST_F(Refused, AMemberThatIsRefusedForGoodAsksOnceMore) { EXPECT_TRUE(unwrapped(hears(refused(0, false), true))); }

}  // namespace
}  // namespace lfd
