// Membership: who is let in, who is refused and why, who is put out and comes back.
#include "controller/membership.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace lfd::controller {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const Clock::time_point kStart{};

Membership two_nodes() {
  return Membership(
      {.version = "1.2", .calibration_hash = "c0", .nodes = {"left", "right"}, .patience = 3s, .heartbeat = 500ms});
}

proto::Join join_of(const std::string& name, std::uint64_t process = 1, proto::Role role = proto::NODE) {
  proto::Join join;
  join.set_role(role);
  join.set_name(name);
  join.set_version("1.2");
  join.set_calibration_hash("c0");
  join.set_process(process);
  return join;
}

TEST(Membership, TakesANodeOfTheDeployment) {
  Membership members = two_nodes();
  ASSERT_TRUE(members.join(join_of("left"), "A", kStart));
  EXPECT_EQ(members.find("left")->phase, Phase::kJoining);
  EXPECT_THAT(members.ready_nodes(), IsEmpty());
  members.holds("A", "h", true);
  EXPECT_THAT(members.ready_nodes(), ElementsAre("left"));
}

TEST(Membership, IsNotReadyWithAStateThatWasNeverPublished) {
  Membership members = two_nodes();
  ASSERT_TRUE(members.join(join_of("left"), "A", kStart));
  members.holds("A", "foreign", false);
  EXPECT_THAT(members.ready_nodes(), IsEmpty());
}

TEST(Membership, RefusesWithTheReason) {
  Membership members = two_nodes();
  EXPECT_THAT(members.join(join_of("middle"), "A", kStart).error().message(),
              HasSubstr("no node \"middle\"; it has left, right"));
  proto::Join old = join_of("left");
  old.set_version("1.1");
  EXPECT_THAT(members.join(old, "A", kStart).error().message(), HasSubstr("version 1.1"));
  proto::Join other = join_of("left");
  other.set_calibration_hash("c1");
  EXPECT_THAT(members.join(other, "A", kStart).error().message(), HasSubstr("calibration c1"));
  other.clear_calibration_hash();
  EXPECT_EQ(members.join(other, "A", kStart).error().message(),
            "display calibration (none) is not the controller's c0");
  EXPECT_FALSE(members.join(join_of("client", 1, proto::CLIENT), "A", kStart));
  EXPECT_FALSE(members.join(join_of("left", 1, proto::DISPLAY), "A", kStart));
  EXPECT_FALSE(members.join(join_of("", 1, proto::DISPLAY), "A", kStart));
}

TEST(Membership, OnlyADisplayMayComeWithoutACalibrationAndTakesTheControllers) {
  Membership members = two_nodes();
  proto::Join join = join_of("screen", 1, proto::DISPLAY);
  join.set_calibration_hash("c1");
  EXPECT_FALSE(members.join(join, "A", kStart));
  join.clear_calibration_hash();
  EXPECT_EQ(*members.join(join, "A", kStart), "screen");
}

Membership with_left_at_a() {
  Membership members = two_nodes();
  EXPECT_EQ(*members.join(join_of("left", 11), "A", kStart), "left");
  members.welcomed("left", kStart);
  return members;
}

TEST(Membership, RefusesANameOfWhichSomethingIsHeard) {
  Membership members = with_left_at_a();
  EXPECT_FALSE(members.join(join_of("left", 12), "B", kStart + 1s)->has_value());
  members.heard("A", kStart + 1400ms);
  EXPECT_THAT(members.join(join_of("left", 12), "B", kStart + 1500ms).error().message(),
              HasSubstr("joined already, as process 11"));
  EXPECT_EQ(members.find("left")->address, "A");
  // What it said before it was asked for says nothing of it now.
  EXPECT_FALSE(members.join(join_of("left", 12), "B", kStart + 2s)->has_value());
}

TEST(Membership, GivesTheNameOfACrashedProcessToTheNextOneSoon) {
  Membership members = with_left_at_a();
  members.holds("A", "h", true);
  EXPECT_FALSE(members.join(join_of("left", 12), "B", kStart + 100ms)->has_value());
  members.heard("A", kStart + 200ms);  // was under way
  EXPECT_FALSE(members.join(join_of("left", 12), "B", kStart + 1s)->has_value());
  EXPECT_EQ(*members.join(join_of("left", 12), "B", kStart + 1100ms), "left");
  EXPECT_EQ(members.find("left")->phase, Phase::kJoining);
  EXPECT_EQ(members.heard("A", kStart + 2s), Membership::Heard::kStranger);
}

TEST(Membership, ARivalThatGivesUpDoesNotShortenTheDoubtOfTheNext) {
  Membership members = with_left_at_a();
  EXPECT_FALSE(members.join(join_of("left", 12), "B", kStart)->has_value());
  EXPECT_FALSE(members.join(join_of("left", 13), "C", kStart + 5s)->has_value());
  EXPECT_EQ(*members.join(join_of("left", 13), "C", kStart + 6s), "left");
}

TEST(Membership, IsNotReadyForOtherModulesUntilItSaysSo) {
  Membership members = with_left_at_a();
  members.holds("A", "h", true);
  members.reassigned("left");
  EXPECT_THAT(members.ready_nodes(), IsEmpty());
  members.holds("A", "h", false);  // the heartbeat was of the modules before
  EXPECT_THAT(members.ready_nodes(), IsEmpty());
  members.holds("A", "h", true);
  EXPECT_THAT(members.ready_nodes(), ElementsAre("left"));
}

TEST(Membership, TakesTheNewestOfANameThatHasNotBeenWelcomed) {
  Membership members = two_nodes();
  ASSERT_TRUE(members.join(join_of("left", 11), "A", kStart));
  ASSERT_TRUE(members.join(join_of("left", 12), "B", kStart));
  EXPECT_EQ(members.find("left")->process, 12u);
}

TEST(Membership, TakesOneDisplayAtATime) {
  Membership members = two_nodes();
  ASSERT_TRUE(members.join(join_of("screen", 1, proto::DISPLAY), "A", kStart));
  EXPECT_FALSE(members.join(join_of("other screen", 2, proto::DISPLAY), "B", kStart)->has_value());
  members.heard("A", kStart + 400ms);
  EXPECT_THAT(members.join(join_of("other screen", 2, proto::DISPLAY), "B", kStart + 500ms).error().message(),
              HasSubstr("\"screen\" has joined already"));
  members.holds("A", "", false);
  EXPECT_EQ(members.display()->phase, Phase::kReady);
  ASSERT_EQ(members.leave("A"), "screen");
  EXPECT_EQ(members.display(), nullptr);
  EXPECT_TRUE(members.join(join_of("other screen", 2, proto::DISPLAY), "B", kStart));
}

TEST(Membership, KeepsAndRepeatsNothingThatIsTooLong) {
  Membership members = two_nodes();
  const std::string much(1000, 'x');
  std::vector<proto::Join> joins(4, join_of("d", 1, proto::DISPLAY));
  joins[0].set_name(much);
  joins[1].set_version(much);
  joins[2].set_calibration_hash(much);
  joins[3].set_images_endpoint(much);
  for (const proto::Join& join : joins)
    EXPECT_EQ(members.join(join, "A", kStart).error().message(), "a name, version, hash or address that is too long");
  ASSERT_TRUE(members.join(join_of("left"), "A", kStart));
  members.holds("A", much, false);
  EXPECT_LT(members.find("left")->state_hash.size(), 100U);
}

TEST(Membership, TakesTheSameProcessFromANewAddress) {
  Membership members = two_nodes();
  ASSERT_TRUE(members.join(join_of("left", 11), "A", kStart));
  ASSERT_TRUE(members.join(join_of("left", 11), "B", kStart));
  EXPECT_EQ(members.find("left")->address, "B");
  EXPECT_EQ(members.heard("A", kStart), Membership::Heard::kStranger);
}

TEST(Membership, PutsOutTheSilentAndTakesThemBack) {
  Membership members = two_nodes();
  for (const auto& [name, address] : {std::pair("left", "A"), std::pair("right", "B")}) {
    ASSERT_TRUE(members.join(join_of(name), address, kStart));
    members.welcomed(name, kStart);
    members.holds(address, "h", true);
  }
  EXPECT_EQ(members.heard("A", kStart + 2s), Membership::Heard::kMember);
  EXPECT_THAT(members.expire(kStart + 3s), IsEmpty());
  EXPECT_THAT(members.expire(kStart + 4s), ElementsAre("right"));
  EXPECT_THAT(members.expire(kStart + 4s), IsEmpty());
  EXPECT_EQ(members.find("right")->phase, Phase::kOut);
  ASSERT_TRUE(members.join(join_of("right", 12), "C", kStart));
  EXPECT_EQ(members.find("right")->phase, Phase::kJoining);
}

TEST(Membership, TakesBackWhoWasSilentAndSpeaksAgain) {
  Membership members = two_nodes();
  ASSERT_TRUE(members.join(join_of("left"), "A", kStart));
  members.welcomed("left", kStart);
  members.holds("A", "h", true);
  ASSERT_THAT(members.expire(kStart + 4s), ElementsAre("left"));
  EXPECT_EQ(members.heard("A", kStart + 5s), Membership::Heard::kBack);
  EXPECT_EQ(members.find("left")->phase, Phase::kJoining);
  EXPECT_EQ(members.heard("A", kStart + 5s), Membership::Heard::kMember);
  EXPECT_THAT(members.expire(kStart + 6s), IsEmpty());
}

TEST(Membership, DoesNotTakeBackWhoLeftOrWasReplaced) {
  Membership members = two_nodes();
  ASSERT_TRUE(members.join(join_of("left", 11), "A", kStart));
  ASSERT_TRUE(members.leave("A"));
  EXPECT_EQ(members.heard("A", kStart), Membership::Heard::kStranger);
  ASSERT_TRUE(members.join(join_of("left", 12), "B", kStart));
  members.welcomed("left", kStart);
  ASSERT_THAT(members.expire(kStart + 4s), ElementsAre("left"));
  ASSERT_TRUE(members.join(join_of("left", 13), "C", kStart));
  EXPECT_EQ(members.heard("B", kStart + 4s), Membership::Heard::kStranger);
}

TEST(Membership, AnAddressIsThatOfTheKeyThatJoinedThereAlsoOnceItIsOut) {
  Membership members = two_nodes();
  ASSERT_TRUE(members.join(join_of("left", 11), "A", kStart, "left"));
  members.welcomed("left", kStart);
  EXPECT_EQ(members.other_at("A", "left"), nullptr);
  ASSERT_NE(members.other_at("A", "right"), nullptr);
  EXPECT_EQ(members.other_at("A", "right")->name, "left");
  EXPECT_EQ(members.other_at("B", "right"), nullptr);
  ASSERT_THAT(members.expire(kStart + 4s), ElementsAre("left"));
  EXPECT_NE(members.other_at("A", "right"), nullptr) << "it would be taken back by a word from there";
  ASSERT_TRUE(members.join(join_of("left", 12), "B", kStart + 5s, "left"));
  EXPECT_EQ(members.other_at("A", "right"), nullptr);
  ASSERT_TRUE(members.leave("B"));
  EXPECT_EQ(members.other_at("", "right"), nullptr) << "who has left has no address";
}

TEST(Membership, DoesNotExpectToHearWhoWaitsForItsWelcome) {
  Membership members = two_nodes();
  ASSERT_TRUE(members.join(join_of("left"), "A", kStart));
  EXPECT_THAT(members.expire(kStart + 1h), IsEmpty());
}

}  // namespace
}  // namespace lfd::controller
