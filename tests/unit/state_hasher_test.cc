// The hash that updates keep is the hash of the state that they make, and tells states apart.
#include "proto/state_hasher.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "proto/state.h"

namespace lfd {
namespace {

void set_place(google::protobuf::RepeatedField<double>& place, double number) {
  place.Clear();
  for (int i = 0; i < 12; ++i) place.Add(number + i);
}

proto::Scene scene_of(int instances, int lights, double number = 0) {
  proto::Scene scene;
  scene.set_name("scene " + std::to_string(number));
  for (int i = 0; i < instances; ++i) {
    scene.add_instance()->set_mesh("mesh " + std::to_string(i % 3));
    set_place(*scene.mutable_instance(i)->mutable_world_from_mesh(), number + i);
  }
  for (int i = 0; i < lights; ++i) scene.add_light()->set_range_m(number + i);
  return scene;
}

proto::State state_of(int instances, int lights) {
  proto::State state;
  *state.mutable_scene() = scene_of(instances, lights);
  state.mutable_roi()->mutable_world_size()->set_x(1);
  (*state.mutable_render()->mutable_ao()->mutable_parameter())["directions"] = 8;
  return state;
}

proto::Update move_of(std::uint32_t index, double number) {
  proto::Update update;
  update.add_moved_instance()->set_index(index);
  set_place(*update.mutable_moved_instance(0)->mutable_world_from_mesh(), number);
  return update;
}

class RandomUpdates {
 public:
  proto::Update next(const proto::State& state) {
    proto::Update update;
    update.set_sequence(state.sequence() + 1);
    if (one_in(8)) *update.mutable_scene() = scene_of(below(6), below(4), below(3));
    const proto::Scene& scene = update.has_scene() ? update.scene() : state.scene();
    if (scene.instance_size() > 0) {
      for (int i = below(4); i > 0; --i) {  // perhaps one of them twice
        proto::MovedInstance& moved = *update.add_moved_instance();
        moved.set_index(static_cast<std::uint32_t>(below(scene.instance_size())));
        if (one_in(3)) moved.set_mesh("mesh " + std::to_string(below(3)));
        set_place(*moved.mutable_world_from_mesh(), below(5));
      }
    }
    if (scene.light_size() > 0 && one_in(2)) {
      proto::MovedLight& moved = *update.add_moved_light();
      moved.set_index(static_cast<std::uint32_t>(below(scene.light_size())));
      moved.mutable_light()->set_range_m(below(5));
    }
    if (one_in(3)) update.mutable_roi()->mutable_world_size()->set_x(below(3));
    if (one_in(3)) {
      for (const char* const name : {"a", "b", "c"})
        (*update.mutable_render()->mutable_ao()->mutable_parameter())[name] = below(2);
    }
    if (one_in(3)) update.set_buffers(static_cast<std::uint32_t>(below(4)));
    return update;
  }

 private:
  int below(int end) { return std::uniform_int_distribution<int>(0, end - 1)(random_); }
  bool one_in(int count) { return below(count) == 0; }

  std::mt19937 random_{7};
};

TEST(StateHasher, KeepsTheHashOfTheWholeStateThroughAnyUpdates) {
  proto::State state;
  StateHasher hasher(state);
  ASSERT_EQ(hasher.hash(), state_hash(state));
  RandomUpdates updates;
  for (int i = 0; i < 2000; ++i) {
    const proto::Update update = updates.next(state);
    ASSERT_TRUE(apply_update(state, update));
    hasher.updated(state, update);
    ASSERT_EQ(hasher.hash(), state_hash(state)) << "update " << i << ": " << update.ShortDebugString();
  }
}

TEST(StateHash, TellsStatesApartByAllButTheirNumber) {
  const proto::State state = state_of(3, 2);
  const std::vector<std::pair<std::string, std::function<void(proto::State&)>>> changes{
      {"instances swapped", [](auto& s) { s.mutable_scene()->mutable_instance()->SwapElements(0, 2); }},
      {"an instance moved", [](auto& s) { s.mutable_scene()->mutable_instance(1)->set_world_from_mesh(3, 99); }},
      {"another mesh", [](auto& s) { s.mutable_scene()->mutable_instance(1)->set_mesh("other"); }},
      {"one instance less", [](auto& s) { s.mutable_scene()->mutable_instance()->RemoveLast(); }},
      {"an empty instance more", [](auto& s) { s.mutable_scene()->add_instance(); }},
      {"lights swapped", [](auto& s) { s.mutable_scene()->mutable_light()->SwapElements(0, 1); }},
      {"an empty light more", [](auto& s) { s.mutable_scene()->add_light(); }},
      {"a material", [](auto& s) { s.mutable_scene()->add_material(); }},
      {"other bounds", [](auto& s) { s.mutable_scene()->mutable_bounds_low()->set_x(1); }},
      {"another region", [](auto& s) { s.mutable_roi()->mutable_world_size()->set_x(2); }},
      {"no region", [](auto& s) { s.clear_roi(); }},
      {"an empty region", [](auto& s) { s.mutable_roi()->Clear(); }},
      {"other settings", [](auto& s) { s.mutable_render()->set_unlit(true); }},
      {"no settings", [](auto& s) { s.clear_render(); }},
      {"buffers", [](auto& s) { s.set_buffers(1); }},
      {"no scene", [](auto& s) { s.clear_scene(); }},
      {"an empty scene", [](auto& s) { s.mutable_scene()->Clear(); }},
  };
  std::vector<std::pair<std::string, std::string>> known{{"as it is", state_hash(state)}};
  for (const auto& [name, change] : changes) {
    proto::State changed = state;
    change(changed);
    const std::string hash = state_hash(changed);
    for (const auto& [other, other_hash] : known) EXPECT_NE(hash, other_hash) << name << ", " << other;
    known.emplace_back(name, hash);
  }
  proto::State later = state;
  later.set_sequence(77);
  EXPECT_EQ(state_hash(later), state_hash(state));
}

TEST(StateHasher, KnowsAStateAgainThatCameBack) {
  proto::State state = state_of(3, 0);
  StateHasher hasher(state);
  const std::string before = hasher.hash();
  std::vector<std::string> hashes;
  for (const double number : {5.0, 1.0}) {  // instance 1 is at 1 at first
    proto::Update update = move_of(1, number);
    update.set_sequence(state.sequence() + 1);
    ASSERT_TRUE(apply_update(state, update));
    hasher.updated(state, update);
    hashes.push_back(hasher.hash());
  }
  EXPECT_NE(hashes[0], before);
  EXPECT_EQ(hashes[1], before);
}

TEST(StateHasher, AnUpdateCostsWhatItTouches) {
  std::vector<std::uint64_t> hashed;
  for (const int instances : {1, 10'000}) {
    proto::State state = state_of(instances, instances);
    StateHasher hasher(state);
    const std::uint64_t whole = hasher.hashed_bytes();
    proto::Update update = move_of(0, 9);
    update.add_moved_light();
    update.set_buffers(3);
    update.set_sequence(1);
    ASSERT_TRUE(apply_update(state, update));
    hasher.updated(state, update);
    hashed.push_back(hasher.hashed_bytes() - whole);
    EXPECT_GE(whole, static_cast<std::uint64_t>(96 * instances)) << "12 numbers of each";
  }
  EXPECT_GT(hashed[0], 96U);
  EXPECT_EQ(hashed[1], hashed[0]);
}

}  // namespace
}  // namespace lfd
