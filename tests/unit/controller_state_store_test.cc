// The state: numbered updates, the same on both sides, and a hash that does not know the number.
#include "controller/state_store.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "proto/state.h"

namespace lfd::controller {
namespace {

proto::Update scene_of(int instances) {
  proto::Update update;
  for (int i = 0; i < instances; ++i) update.mutable_scene()->add_instance()->set_mesh(std::to_string(i));
  return update;
}

// An instance whose place begins with this number.
proto::MovedInstance moved_to(std::uint32_t index, double number) {
  proto::MovedInstance moved;
  moved.set_index(index);
  for (int i = 0; i < 12; ++i) moved.add_world_from_mesh(i == 0 ? number : i);
  return moved;
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
    if (i % 4 == 0) *update.add_moved_instance() = moved_to(static_cast<std::uint32_t>(i % 3), i);
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

TEST(ApplyUpdate, MovesWhatIsNamedAndLeavesTheRest) {
  proto::State state;
  proto::Update update = scene_of(3);
  for (int i = 0; i < 2; ++i) update.mutable_scene()->add_light()->set_range_m(i);
  update.set_sequence(1);
  ASSERT_TRUE(apply_update(state, update));
  proto::State expected = state;
  proto::Update moved;
  moved.set_sequence(2);
  *moved.add_moved_instance() = moved_to(2, 9);
  *moved.add_moved_instance() = moved_to(0, 8);
  moved.mutable_moved_instance(1)->set_mesh("mirrored");
  moved.add_moved_light()->set_index(1);
  moved.mutable_moved_light(0)->mutable_light()->set_range_m(5);
  ASSERT_TRUE(apply_update(state, moved));
  expected.set_sequence(2);
  *expected.mutable_scene()->mutable_instance(2)->mutable_world_from_mesh() = moved_to(2, 9).world_from_mesh();
  *expected.mutable_scene()->mutable_instance(0)->mutable_world_from_mesh() = moved_to(0, 8).world_from_mesh();
  expected.mutable_scene()->mutable_instance(0)->set_mesh("mirrored");
  expected.mutable_scene()->mutable_light(1)->set_range_m(5);
  EXPECT_EQ(state.SerializeAsString(), expected.SerializeAsString());
}

TEST(ApplyUpdate, RefusesMovesOfWhatIsNotThereAndToNoPlace) {
  proto::State state;
  proto::Update update = scene_of(2);
  update.mutable_scene()->add_light();
  update.set_sequence(1);
  ASSERT_TRUE(apply_update(state, update));
  const std::string before = state.SerializeAsString();
  const auto refusal = [&](const std::function<void(proto::Update&)>& fill) {
    proto::Update moved;
    moved.set_sequence(2);
    moved.set_buffers(7);
    *moved.add_moved_instance() = moved_to(0, 1);
    fill(moved);
    const Status applied = apply_update(state, moved);
    EXPECT_EQ(state.SerializeAsString(), before);
    return applied ? "none" : applied.error().message();
  };
  EXPECT_EQ(refusal([](auto& u) { *u.add_moved_instance() = moved_to(2, 1); }),
            "update 2 moves instance 2; the scene has 2");
  EXPECT_EQ(refusal([](auto& u) { *u.add_moved_instance() = moved_to(~0U, 1); }),
            "update 2 moves instance 4294967295; the scene has 2");
  EXPECT_EQ(refusal([](auto& u) { u.add_moved_instance()->add_world_from_mesh(1); }),
            "update 2 moves instance 0 to a place of 1 numbers; 12 are needed");
  EXPECT_EQ(refusal([](auto& u) { u.add_moved_light()->set_index(1); }), "update 2 moves light 1; the scene has 1");
  // What comes with a scene is of that scene.
  EXPECT_EQ(refusal([](auto& u) {
              *u.mutable_scene() = scene_of(1).scene();
              *u.add_moved_instance() = moved_to(1, 1);
            }),
            "update 2 moves instance 1; the scene has 1");
}

}  // namespace
}  // namespace lfd::controller
