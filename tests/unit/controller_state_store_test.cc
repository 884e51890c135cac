// The state: numbered updates, the same on both sides, and a hash that does not know the number.
#include "controller/state_store.h"

#include <gtest/gtest.h>

#include "proto/state.h"

namespace lfd::controller {
namespace {

proto::Update scene_of(int instances) {
  proto::Update update;
  for (int i = 0; i < instances; ++i) update.mutable_scene()->add_instance()->set_mesh(std::to_string(i));
  return update;
}

TEST(StateStore, NumbersUpdatesByOne) {
  StateStore store;
  EXPECT_EQ(store.change(scene_of(2)).sequence(), 1u);
  proto::Update buffers;
  buffers.set_buffers(6);
  EXPECT_EQ(store.change(buffers).sequence(), 2u);
  EXPECT_EQ(store.state().buffers(), 6u);
  EXPECT_EQ(store.state().scene().instance_size(), 2);
}

TEST(StateStore, EqualsAFollowerAfterAnyUpdates) {
  StateStore store;
  proto::State follower = store.state();
  for (int i = 0; i < 20; ++i) {
    proto::Update update = i % 7 == 0 ? scene_of(3) : proto::Update();
    if (i % 2 == 0) update.set_buffers(static_cast<std::uint32_t>(i));
    if (i % 3 == 0) update.mutable_roi()->mutable_world_size()->set_x(i);
    if (i % 5 == 0) update.mutable_render()->set_unlit(i % 10 == 0);
    const proto::Update numbered = store.change(update);
    ASSERT_TRUE(apply_update(follower, numbered));
    ASSERT_EQ(state_hash(follower), store.hash());
  }
}

TEST(StateStore, HashesWithoutTheNumber) {
  StateStore store;
  const std::string before = store.hash();
  store.change({});
  EXPECT_EQ(store.hash(), before);
  store.change(scene_of(1));
  EXPECT_NE(store.hash(), before);
  EXPECT_TRUE(store.remembers(before));
  EXPECT_FALSE(store.remembers(""));
}

TEST(ApplyUpdate, RefusesGapsAndRepetitions) {
  proto::State state;
  state.set_sequence(4);
  proto::Update update;
  for (const std::uint64_t sequence : {4, 6, 0}) {
    update.set_sequence(sequence);
    EXPECT_FALSE(apply_update(state, update)) << sequence;
  }
  update.set_sequence(5);
  EXPECT_TRUE(apply_update(state, update));
}

TEST(ApplyUpdate, RefusesPlacesForAnotherNumberOfInstances) {
  proto::State state;
  proto::Update update = scene_of(2);
  update.set_sequence(1);
  ASSERT_TRUE(apply_update(state, update));
  proto::Update moved;
  moved.set_sequence(2);
  moved.add_instance();
  const std::string before = state.SerializeAsString();
  EXPECT_FALSE(apply_update(state, moved));
  EXPECT_EQ(state.SerializeAsString(), before);
}

}  // namespace
}  // namespace lfd::controller
