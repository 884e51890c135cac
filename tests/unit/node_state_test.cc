// What a node knows of the state.
#include <gtest/gtest.h>

#include "proto/state_follower.h"

namespace lfd::node {
namespace {

proto::State state_at(std::uint64_t sequence) {
  proto::State state;
  state.set_sequence(sequence);
  state.mutable_scene()->add_light();
  return state;
}

proto::Update update_at(std::uint64_t sequence, std::uint32_t buffers) {
  proto::Update update;
  update.set_sequence(sequence);
  update.set_buffers(buffers);
  return update;
}

TEST(StateFollower, FollowsUpdatesThatCountByOne) {
  StateFollower follower;
  EXPECT_EQ(follower.state(), nullptr);
  EXPECT_EQ(follower.hash(), "");
  follower.snapshot_came(state_at(5));
  follower.update_came(update_at(6, 3));
  EXPECT_EQ(follower.sequence(), 6u);
  EXPECT_EQ(follower.state()->buffers(), 3u);
  EXPECT_EQ(follower.hash(), state_hash(*follower.state()));
  EXPECT_FALSE(follower.has_gap());
}

TEST(StateFollower, AnUpdateMakesANewStateAndLeavesTheOldOneAlone) {
  StateFollower follower;
  follower.snapshot_came(state_at(1));
  const auto before = follower.state();
  follower.update_came(update_at(2, 7));
  EXPECT_EQ(before->buffers(), 0u);
}

TEST(StateFollower, AMissingNumberIsAGapUntilASnapshotComes) {
  StateFollower follower;
  follower.snapshot_came(state_at(1));
  follower.update_came(update_at(3, 7));
  EXPECT_TRUE(follower.has_gap());
  EXPECT_EQ(follower.sequence(), 1u);
  follower.snapshot_came(state_at(3));
  EXPECT_FALSE(follower.has_gap());
  EXPECT_EQ(follower.sequence(), 3u);
}

TEST(StateFollower, APulseTellsOfUpdatesThatWereLostWithNothingAfterThem) {
  StateFollower follower;
  follower.snapshot_came(state_at(4));
  follower.pulse_came(4);
  EXPECT_FALSE(follower.has_gap());
  follower.pulse_came(5);
  EXPECT_TRUE(follower.has_gap());
}

TEST(StateFollower, WhatIsOlderThanTheStateIsPassedOver) {
  StateFollower follower;
  follower.snapshot_came(state_at(4));
  follower.update_came(update_at(4, 9));
  follower.snapshot_came(state_at(2));
  EXPECT_EQ(follower.sequence(), 4u);
  EXPECT_EQ(follower.state()->buffers(), 0u);
  EXPECT_FALSE(follower.has_gap());
}

}  // namespace
}  // namespace lfd::node
