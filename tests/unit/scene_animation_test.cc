// Node animation of glTF files at times with known answers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/gltf_maker.h"

namespace lfd::test {
namespace {

constexpr double kFloatKeys = 1e-6;  // keys are stored as float

GltfMaker moving(const std::string& path, const std::string& interpolation, const std::vector<float>& times,
                 const std::vector<float>& values) {
  GltfMaker maker = GltfMaker::triangle();
  maker.animate(path, interpolation, times, values);
  return maker;
}

double number(const LoadedScene& scene, double seconds, int which) {
  return scene.animations.at(seconds).instances.at(0).world_from_mesh(which);
}

TEST(SceneAnimation, WithoutAnyNothingMoves) {
  const LoadedScene scene = loaded(GltfMaker::triangle());
  EXPECT_TRUE(scene.animations.empty());
  EXPECT_TRUE(scene.animations.at(1).instances.empty());
}

TEST(SceneAnimation, LinearTranslationAndItsEnds) {
  const LoadedScene scene = loaded(moving("translation", "LINEAR", {1, 3}, {0, 0, 0, 4, 0, 0}));
  EXPECT_EQ(scene.animations.duration_s(), 3);
  EXPECT_EQ(number(scene, 0, 3), 0);
  EXPECT_EQ(number(scene, 1.5, 3), 1);
  EXPECT_EQ(number(scene, 3, 3), 4);
  EXPECT_EQ(number(scene, 99, 3), 4);
}

TEST(SceneAnimation, StepHoldsUntilTheNextKey) {
  const LoadedScene scene = loaded(moving("scale", "STEP", {0, 1}, {1, 1, 1, 5, 5, 5}));
  EXPECT_EQ(number(scene, 0.999, 0), 1);
  EXPECT_EQ(number(scene, 1, 0), 5);
}

TEST(SceneAnimation, RotationsTurnAtConstantSpeedTheShorterWay) {
  const auto h = static_cast<float>(std::sqrt(0.5));
  // The second key is the negative of a quarter turn about z: the same rotation.
  const LoadedScene scene = loaded(moving("rotation", "LINEAR", {0, 3}, {0, 0, 0, 1, 0, 0, -h, -h}));
  for (const double share : {0.0, 0.1, 1.0 / 3, 0.5, 0.9, 1.0}) {
    const double angle = share * std::numbers::pi / 2;
    EXPECT_NEAR(number(scene, 3 * share, 0), std::cos(angle), kFloatKeys) << share;
    EXPECT_NEAR(number(scene, 3 * share, 4), std::sin(angle), kFloatKeys) << share;
  }
}

// One segment of two seconds from 0 to 1, leaving at 3 per second, arriving at -1 per second.
TEST(SceneAnimation, CubicSplineIsHermite) {
  const LoadedScene scene = loaded(
      moving("translation", "CUBICSPLINE", {0, 2}, {0, 0, 0, 0, 0, 0, 3, 0, 0, /**/ -1, 0, 0, 1, 0, 0, 0, 0, 0}));
  // x(t) = a t^3 + b t^2 + 3 t with x(2) = 1, x'(2) = -1.
  const double a = 0.25;
  const double b = -1.75;
  for (const double t : {0.0, 0.5, 1.0, 1.7, 2.0})
    EXPECT_NEAR(number(scene, t, 3), a * t * t * t + b * t * t + 3 * t, kFloatKeys);
}

TEST(SceneAnimation, CubicRotationsStayRotations) {
  const auto h = static_cast<float>(std::sqrt(0.5));
  const LoadedScene scene = loaded(moving("rotation", "CUBICSPLINE", {0, 1},
                                          {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, h, h, 0, 0, 0, 0}));
  for (const double t : {0.2, 0.5, 0.8})
    EXPECT_NEAR(std::hypot(number(scene, t, 0), number(scene, t, 4)), 1, kFloatKeys);
}

TEST(SceneAnimation, ChildrenMoveWithTheirParents) {
  GltfMaker maker = moving("translation", "LINEAR", {0, 1}, {0, 0, 0, 2, 0, 0});
  maker.root["nodes"] = {{{"children", {1}}}, {{"mesh", 0}, {"translation", {0, 7, 0}}}};
  const LoadedScene scene = loaded(maker);
  EXPECT_EQ(number(scene, 0.5, 3), 1);
  EXPECT_EQ(number(scene, 0.5, 7), 7);
}

// Node 0 rests with node 1 below it, which moves 2 m along x in a second, with node 2 below that; node 3 rests.
GltfMaker moving_in_the_middle() {
  GltfMaker maker = moving("translation", "LINEAR", {0, 1}, {0, 0, 0, 2, 0, 0});
  maker.root["animations"][0]["channels"][0]["target"]["node"] = 1;
  maker.root["nodes"] = {{{"mesh", 0}, {"children", {1}}, {"translation", {0, 0, 5}}},
                         {{"mesh", 0}, {"children", {2}}},
                         {{"mesh", 0}, {"translation", {0, 7, 0}}},
                         {{"mesh", 0}}};
  maker.root["scenes"][0]["nodes"] = {3, 0};
  maker.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
  for (const int node : {3, 2}) maker.root["nodes"][node]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  return maker;
}

TEST(SceneAnimation, OnlyNodesWithAMovingNodeAboveThemAreLookedAt) {
  const LoadedScene scene = loaded(moving_in_the_middle());
  EXPECT_EQ(scene.animations.moving_node_count(), 2U);
  const scene::Moved moved = scene.animations.at(0.5);
  ASSERT_EQ(moved.instances.size(), 2U);
  for (const proto::MovedInstance& one : moved.instances) {
    const proto::Instance& at_rest = scene.data.scene.instance(static_cast<int>(one.index()));
    EXPECT_EQ(one.world_from_mesh(3), at_rest.world_from_mesh(3) + 1);
    EXPECT_EQ(one.world_from_mesh(7), at_rest.world_from_mesh(7));
    EXPECT_EQ(one.world_from_mesh(11), 5) << "of the parent that rests";
  }
  EXPECT_NE(moved.instances[0].world_from_mesh(7), moved.instances[1].world_from_mesh(7));
  ASSERT_EQ(moved.lights.size(), 1U);
  const proto::Light& light = moved.lights[0].light();
  EXPECT_EQ(light.position().x(), 1);
  EXPECT_EQ(light.position().y(), 7);
  EXPECT_EQ(scene.data.scene.light(static_cast<int>(moved.lights[0].index())).position().y(), 7);
}

TEST(SceneAnimation, ScaleThroughZeroChangesToTheMirroredMesh) {
  const LoadedScene scene = loaded(moving("scale", "LINEAR", {0, 2}, {1, 1, 1, -1, 1, 1}));
  const std::string before = scene.animations.at(0.5).instances.at(0).mesh();
  const std::string after = scene.animations.at(1.5).instances.at(0).mesh();
  EXPECT_NE(before, after);
  EXPECT_TRUE(scene.data.assets.contains(before));
  EXPECT_TRUE(scene.data.assets.contains(after));
}

TEST(SceneAnimation, LightsMoveWithTheirNodes) {
  GltfMaker maker = moving("translation", "LINEAR", {0, 1}, {0, 0, 0, 2, 0, 0});
  maker.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
  maker.root["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  const LoadedScene scene = loaded(maker);
  EXPECT_EQ(scene.animations.at(0.5).lights.at(0).light().position().x(), 1);
}

TEST(SceneAnimation, RestIsWhatTheNodesSay) {
  const LoadedScene scene = loaded(moving("translation", "LINEAR", {0, 1}, {9, 0, 0, 2, 0, 0}));
  EXPECT_EQ(scene.data.scene.instance(0).world_from_mesh(3), 0);
}

TEST(SceneAnimation, TimesThatDoNotGrowAreRefused) {
  const std::string error = error_of(moving("translation", "LINEAR", {1, 1}, {0, 0, 0, 4, 0, 0}));
  EXPECT_THAT(error, ::testing::HasSubstr("animation 0: channel 0: sampler 0: input: accessor 1: key 1"));
}

TEST(SceneAnimation, KeysWithoutValuesAreRefused) {
  const std::string error = error_of(moving("translation", "CUBICSPLINE", {0, 1}, {0, 0, 0, 4, 0, 0}));
  EXPECT_THAT(error, ::testing::HasSubstr("2 values for 2 keys"));
}

}  // namespace
}  // namespace lfd::test
