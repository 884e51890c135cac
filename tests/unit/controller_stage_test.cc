// The stage: what moves stands where the frame's time says, whatever frames were drawn before.
#include "controller/stage.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>

#include "proto/state.h"
#include "tests/support/unwrapped.h"
#include "tests/unit/gltf_maker.h"

namespace lfd::controller {
namespace {

using test::GltfMaker;
using test::loaded;
using testing_support::unwrapped;

// A triangle that goes 2 m along x in the first second and 1 m back in the second one.
GltfMaker moving() {
  GltfMaker maker = GltfMaker::triangle();
  maker.animate("translation", "LINEAR", {0, 1, 2}, {0, 0, 0, 2, 0, 0, 1, 0, 0});
  return maker;
}

// Four frames a second, on a screen of 1.6 x 0.9 m.
Stage empty_stage() {
  Deployment deployment;
  deployment.display.screen = {1.6, 0.9};
  deployment.animation_frames_per_second = 4;
  return unwrapped(Stage::of(deployment));
}

Stage stage_with(const GltfMaker& maker) {
  Stage stage = empty_stage();
  EXPECT_TRUE(stage.show(loaded(maker)));
  return stage;
}

// Where the triangle stands along x.
double x_of(const proto::Scene& scene) { return scene.instance(0).world_from_mesh(3); }

TEST(StageAnimate, ChangesNothingWhereNothingMoves) {
  Stage empty = empty_stage(), still = stage_with(GltfMaker::triangle());
  for (Stage* stage : {&empty, &still}) {
    const std::uint64_t sequence = stage->store().sequence();
    EXPECT_FALSE(stage->animate(3));
    EXPECT_EQ(stage->store().sequence(), sequence);
  }
}

TEST(StageAnimate, PlacesWhatMovesByTheFramesTimeRoundAndRound) {
  Stage stage = stage_with(moving());
  EXPECT_EQ(x_of(stage.store().state().scene()), 0);
  // Every number here is exact in double precision.
  for (const auto& [frame, x] : {std::pair<std::uint64_t, double>{0, 0.0},
                                 {1, 0.5},
                                 {2, 1.0},
                                 {4, 2.0},
                                 {5, 1.75},
                                 {7, 1.25},
                                 {8, 0.0},
                                 {12, 2.0},
                                 {8'000'000'001, 0.5}}) {
    const bool stands_there = x_of(stage.store().state().scene()) == x;
    EXPECT_EQ(stage.animate(frame).has_value(), !stands_there) << "frame " << frame;
    EXPECT_EQ(x_of(stage.store().state().scene()), x) << "frame " << frame;
  }
}

TEST(StageAnimate, UpdatesPlacesAlone) {
  Stage stage = stage_with(moving());
  const proto::State before = stage.store().state();
  const RegionOfInterest roi = stage.roi();
  const auto update = stage.animate(3);
  ASSERT_TRUE(update);
  EXPECT_EQ(update->sequence(), before.sequence() + 1);
  ASSERT_EQ(update->moved_instance_size(), 1);
  EXPECT_EQ(update->moved_instance(0).world_from_mesh(3), 1.5);
  EXPECT_EQ(update->moved_instance(0).mesh(), "") << "it is the same as before";
  EXPECT_FALSE(update->has_scene());
  EXPECT_FALSE(update->has_roi());
  EXPECT_FALSE(update->has_render());
  const proto::State& after = stage.store().state();
  EXPECT_EQ(after.sequence(), update->sequence());
  EXPECT_EQ(x_of(after.scene()), 1.5);
  EXPECT_EQ(after.roi().SerializeAsString(), before.roi().SerializeAsString());
  EXPECT_TRUE(stage.roi() == roi);
}

TEST(StageAnimate, DoesNotDependOnTheFramesBefore) {
  Stage one = stage_with(moving()), other = stage_with(moving());
  for (std::uint64_t frame = 1; frame <= 5; ++frame) {
    ASSERT_TRUE(one.animate(frame));
    EXPECT_NE(one.store().hash(), other.store().hash()) << "at rest it is as in frame 0";
  }
  ASSERT_TRUE(other.animate(5));
  EXPECT_EQ(one.store().hash(), other.store().hash());
}

TEST(StageAnimate, TakesLightsAlongWithTheirNodes) {
  GltfMaker maker = moving();
  maker.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
  maker.root["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  Stage stage = stage_with(maker);
  const auto update = stage.animate(1);
  ASSERT_TRUE(update);
  EXPECT_FALSE(update->has_scene());
  EXPECT_EQ(update->moved_light_size(), 1);
  const proto::Scene& scene = stage.store().state().scene();
  ASSERT_EQ(scene.light_size(), 1);
  EXPECT_EQ(scene.light(0).position().x(), 0.5);
  EXPECT_EQ(x_of(scene), 0.5);
}

TEST(StageAnimate, StandsStillWithoutADuration) {
  GltfMaker maker = GltfMaker::triangle();
  maker.animate("translation", "STEP", {0}, {3, 0, 0});
  Stage stage = stage_with(maker);
  for (const std::uint64_t frame : {0, 1, 7}) {
    EXPECT_EQ(stage.animate(frame).has_value(), frame == 0) << "it is there already";
    EXPECT_EQ(x_of(stage.store().state().scene()), 3);
  }
}

TEST(StageAnimate, NamesTheMeshWhereItIsAnother) {
  GltfMaker maker = GltfMaker::triangle();
  maker.animate("scale", "LINEAR", {0, 1, 2}, {1, 1, 1, -1, 1, 1, 1, 1, 1});
  Stage stage = stage_with(maker);
  const std::string at_rest = stage.store().state().scene().instance(0).mesh();
  const auto mesh_in = [&](std::uint64_t frame) { return stage.animate(frame)->moved_instance(0).mesh(); };
  EXPECT_EQ(mesh_in(1), "");
  const std::string mirrored = mesh_in(3);
  EXPECT_NE(mirrored, "");
  EXPECT_NE(mirrored, at_rest);
  EXPECT_EQ(stage.store().state().scene().instance(0).mesh(), mirrored);
  EXPECT_EQ(mesh_in(4), "");
  EXPECT_EQ(mesh_in(7), at_rest);
}

// What moving() has, among so many triangles and lights that rest.
GltfMaker moving_among(int resting) {
  GltfMaker maker = moving();
  maker.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
  maker.root["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  for (int i = 1; i <= resting; ++i) {
    test::json& node = maker.root["nodes"][static_cast<std::size_t>(i)];
    node = {{"mesh", 0}, {"translation", {i % 100, i / 100, 1}}};
    if (i % 10 == 0) node["extensions"]["KHR_lights_punctual"]["light"] = 0;
    maker.root["scenes"][0]["nodes"].push_back(i);
  }
  return maker;
}

// What one frame, and one change of the region of interest, publish and hash. Where things stand takes as many bytes
// everywhere: the numbers that do not differ in length are of the same frame and index.
struct Effort {
  std::size_t frame_bytes, roi_bytes;
  std::uint64_t frame_hashed, roi_hashed;

  bool operator==(const Effort&) const = default;
};

Effort effort_among(int resting) {
  Stage stage = stage_with(moving_among(resting));
  EXPECT_EQ(stage.store().state().scene().instance_size(), resting + 1);
  const auto hashed = [&](const auto& act) {
    const std::uint64_t before = stage.store().hashed_bytes();
    act();
    return stage.store().hashed_bytes() - before;
  };
  Effort effort{};
  proto::RegionOfInterest roi;
  for (auto* v : {roi.mutable_world_centre(), roi.mutable_world_size(), roi.mutable_physical_size()}) {
    v->set_x(1);
    v->set_y(1);
    v->set_z(1);
  }
  effort.frame_hashed = hashed([&] { effort.frame_bytes = stage.animate(3)->ByteSizeLong(); });
  effort.roi_hashed = hashed([&] { effort.roi_bytes = unwrapped(stage.set_roi(roi)).ByteSizeLong(); });
  return effort;
}

TEST(StageAnimate, CostsWhatMovesHoweverMuchRests) {
  const Effort little = effort_among(1);
  EXPECT_GT(little.frame_hashed, 0U);
  EXPECT_LT(little.frame_bytes, 250U) << "a place is 12 numbers of 8 bytes, a light less";
  EXPECT_EQ(effort_among(10'000), little);
}

TEST(StageAnimate, WhoFollowsComesToTheSameHash) {
  Stage stage = stage_with(moving_among(20));
  proto::State follower = stage.store().state();
  for (const std::uint64_t frame : {1, 2, 5, 3, 9}) {
    const auto update = stage.animate(frame);
    ASSERT_TRUE(update);
    ASSERT_TRUE(apply_update(follower, *update));
    EXPECT_EQ(state_hash(follower), stage.store().hash());
  }
}

// The state travels in one message: what does not fit is refused before anybody waits for it, and the old scene stays.
// Nodes would refuse it as well; then nothing would be drawn any more.
TEST(StageSetAo, RefusesAGuardBandThatMakesImagesTooLarge) {
  Deployment deployment;
  deployment.display.screen = {1.6, 0.9};
  deployment.display.image = {8000, 600};
  deployment.animation_frames_per_second = 4;
  Stage stage = unwrapped(Stage::of(deployment));
  ASSERT_TRUE(stage.show(loaded(GltfMaker::triangle())));
  proto::AmbientOcclusion ao;
  ao.set_guard_band_px(96);
  EXPECT_TRUE(stage.set_ao(ao));
  const std::uint64_t sequence = stage.store().sequence();
  ao.set_guard_band_px(98);
  const auto refused = stage.set_ao(ao);
  ASSERT_FALSE(refused);
  EXPECT_EQ(
      refused.error().message(),
      "ao.guard_band_px: images of 8000x600 px become 8196x796 with a guard band of 98 px; at most 8192 px a side "
      "are possible");
  EXPECT_EQ(stage.store().sequence(), sequence);
}

// A stage of a display with two modules.
Stage stage_of_two() {
  Deployment deployment;
  deployment.display.screen = {1.6, 0.9};
  deployment.display.modules.resize(2);
  deployment.animation_frames_per_second = 4;
  Stage stage = unwrapped(Stage::of(deployment));
  EXPECT_TRUE(stage.show(loaded(GltfMaker::triangle())));
  return stage;
}

TEST(StageSetPattern, IsAPartOfTheStateUntilItIsTakenAway) {
  Stage stage = stage_of_two();
  const std::string before = stage.store().hash();
  proto::TestPattern pattern;
  pattern.set_kind(proto::TestPattern::GRID);
  pattern.add_modules("1");
  const auto update = stage.set_pattern(pattern);
  ASSERT_TRUE(update);
  EXPECT_EQ(update->render().pattern().SerializeAsString(), pattern.SerializeAsString());
  EXPECT_NE(stage.store().hash(), before);
  proto::AmbientOcclusion ao;
  ao.set_samples(8);
  ASSERT_TRUE(stage.set_ao(ao));
  ASSERT_TRUE(stage.show(loaded(GltfMaker::triangle())));
  EXPECT_EQ(stage.store().state().render().pattern().kind(), proto::TestPattern::GRID) << "other changes leave it";
  ASSERT_TRUE(stage.set_ao({}));
  ASSERT_TRUE(stage.set_pattern({}));
  EXPECT_FALSE(stage.store().state().render().has_pattern());
}

TEST(StageSetPattern, GivesTheSameStateBack) {
  Stage stage = stage_of_two();
  const std::string before = stage.store().hash();
  proto::TestPattern pattern;
  pattern.set_kind(proto::TestPattern::SOLID);
  ASSERT_TRUE(stage.set_pattern(pattern));
  ASSERT_TRUE(stage.set_pattern({}));
  EXPECT_EQ(stage.store().hash(), before);
}

TEST(StageSetPattern, RefusesModulesThatTheDisplayLacksAndChangesNothing) {
  Stage stage = stage_of_two();
  const std::uint64_t sequence = stage.store().sequence();
  proto::TestPattern pattern;
  pattern.set_kind(proto::TestPattern::SOLID);
  pattern.add_modules("1-2");
  const auto refused = stage.set_pattern(pattern);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message(), "pattern.modules 0: 2; the display has modules 0 to 1");
  EXPECT_EQ(stage.store().sequence(), sequence);
  EXPECT_FALSE(stage.store().state().render().has_pattern());
}

TEST(StageShow, RefusesWhatNoMessageCanHold) {
  Stage stage = stage_with(GltfMaker::triangle());
  const std::string before = stage.store().hash();
  LoadedScene crowd = loaded(GltfMaker::triangle());
  for (int i = 0; i < 500'000; ++i) *crowd.data.scene.add_instance() = crowd.data.scene.instance(0);
  const auto update = stage.show(std::move(crowd));
  ASSERT_FALSE(update);
  EXPECT_NE(update.error().message().find("nodes are sent at most 63 MiB"), std::string::npos)
      << update.error().message();
  EXPECT_EQ(stage.store().hash(), before);
}

}  // namespace
}  // namespace lfd::controller
