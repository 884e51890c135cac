// Joins that are too many, and what keys open at the controller.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "base/log.h"
#include "controller/join_limiter.h"
#include "controller/membership.h"
#include "controller/rights.h"

namespace lfd::controller {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

const Clock::time_point kStart{1000s};

int admitted(JoinLimiter& limiter, const std::string& address, int joins, Clock::time_point now) {
  int count = 0;
  for (int i = 0; i < joins; ++i) count += limiter.admits(address, now) ? 1 : 0;
  return count;
}

TEST(JoinLimiter, AnAddressHasABurstAndThenARate) {
  JoinLimiter limiter;
  EXPECT_EQ(admitted(limiter, "a", 100, kStart), 10);
  EXPECT_EQ(admitted(limiter, "a", 100, kStart + 1s), 5);
  EXPECT_EQ(admitted(limiter, "a", 100, kStart + 1s), 0);
  EXPECT_EQ(admitted(limiter, "b", 3, kStart + 1s), 3) << "others are not concerned";
  EXPECT_EQ(admitted(limiter, "a", 100, kStart + 1h), 10) << "no more than the burst is saved up";
  EXPECT_EQ(limiter.passed_over(), 90U + 95 + 100 + 90);
}

TEST(JoinLimiter, ANodeThatAsksAgainAndAgainIsAlwaysHeard) {
  JoinLimiter limiter;
  for (int i = 0; i < 1000; ++i) EXPECT_TRUE(limiter.admits("node", kStart + i * 300ms));
}

TEST(JoinLimiter, AllTogetherHaveABurstAndThenARate) {
  JoinLimiter limiter;
  const auto from_many = [&](Clock::time_point now, const char* kind) {
    int count = 0;
    for (int i = 0; i < 1000; ++i) count += limiter.admits(fmt::format("{} {}", kind, i), now) ? 1 : 0;
    return count;
  };
  EXPECT_EQ(from_many(kStart, "first"), 256);
  EXPECT_EQ(from_many(kStart + 1s, "second"), 128);
}

TEST(JoinLimiter, RemembersFewHoweverManyComeAndHoweverLong) {
  JoinLimiter limiter;
  std::mt19937 random(1);
  std::size_t most = 0;
  for (int i = 0; i < 200'000; ++i) {
    limiter.admits(fmt::format("{}", random()), kStart + i * 100us);
    most = std::max(most, limiter.remembered());
  }
  EXPECT_LE(most, 600U);
  limiter.admits("last", kStart + 1h);
  EXPECT_EQ(limiter.remembered(), 1U);
}

TEST(JoinLimiter, AClockThatStandsStillGivesNothing) {
  JoinLimiter limiter;
  admitted(limiter, "a", 10, kStart);
  EXPECT_EQ(admitted(limiter, "a", 10, kStart), 0);
  EXPECT_EQ(admitted(limiter, "a", 10, kStart - 1s), 0);
}

TEST(JoinLimiter, TellsAPeerOnceInAWhileAndFewOfMany) {
  JoinLimiter limiter;
  EXPECT_TRUE(limiter.tells("a", kStart));
  EXPECT_FALSE(limiter.tells("a", kStart + 999ms));
  EXPECT_TRUE(limiter.tells("a", kStart + 1s));
  const auto told = [&](Clock::time_point now, int from) {
    int count = 0;
    for (int i = 0; i < 1000; ++i) count += limiter.tells(fmt::format("{}", from + i), now) ? 1 : 0;
    return count;
  };
  EXPECT_EQ(told(kStart + 1h, 0), 64);
  EXPECT_EQ(told(kStart + 1h + 500ms, 1000), 16);
  EXPECT_EQ(limiter.remembered_told(), 80U);
  EXPECT_EQ(told(kStart + 2h, 0), 64);
  EXPECT_EQ(limiter.remembered_told(), 64U) << "those of before are forgotten";
}

TEST(JoinLimiter, WarnsNowAndThenAndOnlyOfNews) {
  JoinLimiter limiter;
  EXPECT_FALSE(limiter.warns(kStart));
  admitted(limiter, "a", 11, kStart);
  EXPECT_TRUE(limiter.warns(kStart));
  EXPECT_FALSE(limiter.warns(kStart + 10s)) << "nothing new";
  admitted(limiter, "a", 50, kStart + 11s);
  EXPECT_TRUE(limiter.warns(kStart + 11s));
  admitted(limiter, "a", 50, kStart + 12s);
  EXPECT_FALSE(limiter.warns(kStart + 12s)) << "just now";
  EXPECT_TRUE(limiter.warns(kStart + 16s));
}

AllowList everybody() {
  using proto::Allowed;
  return {{{"left", "1", {Allowed::NODE}},
           {"right", "2", {Allowed::NODE}},
           {"glass", "3", {Allowed::DISPLAY}},
           {"boss", "4", {Allowed::CONTROL}},
           {"guest", "5", {Allowed::STATUS}}}};
}

proto::Join join_of(proto::Role role, const std::string& name) {
  proto::Join join;
  join.set_role(role);
  join.set_name(name);
  return join;
}

TEST(Rights, ANodeNeedsTheKeyOfItsName) {
  const AllowList all = everybody();
  EXPECT_TRUE(may_join(&all, "left", join_of(proto::NODE, "left")));
  EXPECT_THAT(may_join(&all, "left", join_of(proto::NODE, "right")).error().message(),
              HasSubstr("the key of \"left\" is not that of node \"right\""));
  for (const char* const user : {"glass", "boss", "guest", "nobody", ""})
    EXPECT_THAT(may_join(&all, user, join_of(proto::NODE, user)).error().message(), HasSubstr("has no right NODE"));
}

TEST(Rights, ADisplayNeedsTheKeyOfADisplay) {
  const AllowList all = everybody();
  EXPECT_TRUE(may_join(&all, "glass", join_of(proto::DISPLAY, "any name")));
  for (const char* const user : {"left", "boss", "guest", ""})
    EXPECT_FALSE(may_join(&all, user, join_of(proto::DISPLAY, "glass"))) << user;
}

TEST(Rights, OnlyControlMayChangeTheShow) {
  const AllowList all = everybody();
  proto::Request look, follow, quit, frames, nothing;
  look.mutable_status();
  follow.mutable_follow();
  quit.mutable_quit();
  frames.mutable_frames();
  for (const proto::Request* request : {&look, &follow, &quit, &frames, &nothing})
    EXPECT_TRUE(may_ask(&all, "boss", *request)) << request->ShortDebugString();
  EXPECT_TRUE(may_ask(&all, "guest", look));
  EXPECT_TRUE(may_ask(&all, "guest", follow));
  for (const proto::Request* request : {&quit, &frames, &nothing}) {
    for (const char* const user : {"guest", "left", "glass", ""})
      EXPECT_THAT(may_ask(&all, user, *request).error().message(), HasSubstr("has no right CONTROL"));
  }
  EXPECT_THAT(may_ask(&all, "left", look).error().message(), HasSubstr("has no right STATUS"));
}

TEST(Rights, WithoutKeysEverybodyMay) {
  proto::Request quit;
  quit.mutable_quit();
  EXPECT_TRUE(may_ask(nullptr, "", quit));
  EXPECT_TRUE(may_join(nullptr, "", join_of(proto::NODE, "left")));
}

TEST(Membership, DisplaysOfEverNewNamesAreForgotten) {
  Membership members({.version = "1", .calibration_hash = "", .nodes = {"left"}, .patience = 3s, .heartbeat = 500ms});
  for (int i = 0; i < 1000; ++i) {
    proto::Join join = join_of(proto::DISPLAY, fmt::format("display {}", i));
    join.set_version("1");
    ASSERT_TRUE(members.join(join, fmt::format("address {}", i), {}));
    members.leave(fmt::format("address {}", i));
    members.expire(kStart + i * 1ms);
  }
  EXPECT_LE(members.peers().size(), 12U);
  EXPECT_NE(members.find("left"), nullptr);
}

}  // namespace
}  // namespace lfd::controller
