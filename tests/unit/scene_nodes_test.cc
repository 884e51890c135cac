// Nodes of glTF files: hierarchy, instances, mirrors, lights, bounds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/gltf_maker.h"

namespace lfd::test {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::Pointwise;

// Products of a few double matrices of size about 1: some hundred units of the last place.
constexpr double kRounding = 1e-13;

std::vector<double> transform(const LoadedScene& scene, int instance = 0) {
  const auto& numbers = scene.data.scene.instance(instance).world_from_mesh();
  return {numbers.begin(), numbers.end()};
}

TEST(SceneNodes, ChildrenStandInTheirParents) {
  GltfMaker maker = GltfMaker::triangle();
  const double h = std::sqrt(0.5);  // a quarter turn about z, then a child one metre along its x
  maker.root["nodes"] = {
      {{"children", {1}}, {"rotation", {0, 0, h, h}}, {"translation", {10, 20, 30}}, {"scale", {2, 3, 4}}},
      {{"mesh", 0}, {"translation", {1, 0, 0}}}};
  EXPECT_THAT(transform(loaded(maker)),
              Pointwise(DoubleNear(kRounding), {0.0, -3.0, 0.0, 10.0, 2.0, 0.0, 0.0, 22.0, 0.0, 0.0, 4.0, 30.0}));
}

TEST(SceneNodes, MatrixEqualsTranslationRotationScale) {
  GltfMaker trs = GltfMaker::triangle();
  const double h = std::sqrt(0.5);
  trs.root["nodes"][0].update({{"rotation", {0, 0, h, h}}, {"translation", {10, 20, 30}}, {"scale", {2, 3, 4}}});
  GltfMaker matrix = GltfMaker::triangle();  // by columns
  matrix.root["nodes"][0]["matrix"] = {0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 10, 20, 30, 1};
  EXPECT_THAT(transform(loaded(trs)), Pointwise(DoubleNear(kRounding), transform(loaded(matrix))));
}

TEST(SceneNodes, RotationsNeedNotBeUnit) {
  GltfMaker maker = GltfMaker::triangle();
  maker.root["nodes"][0]["rotation"] = {0, 0, 2, 2};
  EXPECT_THAT(transform(loaded(maker)),
              Pointwise(DoubleNear(kRounding), {0., -1., 0., 0., 1., 0., 0., 0., 0., 0., 1., 0.}));
}

TEST(SceneNodes, SeveralNodesShareOneMesh) {
  GltfMaker maker = GltfMaker::triangle();
  maker.root["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {5, 0, -1}}}};
  maker.root["scenes"][0]["nodes"] = {0, 1};
  const LoadedScene scene = loaded(maker);
  ASSERT_EQ(scene.data.scene.instance_size(), 2);
  EXPECT_EQ(scene.data.scene.instance(0).mesh(), scene.data.scene.instance(1).mesh());
  EXPECT_EQ(scene.data.assets.size(), 1U);
  const proto::Vector& low = scene.data.scene.bounds_low();
  const proto::Vector& high = scene.data.scene.bounds_high();
  EXPECT_THAT((std::vector{low.x(), low.y(), low.z()}), ElementsAre(0, 0, -1));
  EXPECT_THAT((std::vector{high.x(), high.y(), high.z()}), ElementsAre(6, 1, 0));
}

TEST(SceneNodes, EqualMeshesAreStoredOnce) {
  GltfMaker maker = GltfMaker::triangle();
  maker.root["meshes"].push_back(maker.root["meshes"][0]);
  maker.root["nodes"] = {{{"mesh", 0}}, {{"mesh", 1}}};
  maker.root["scenes"][0]["nodes"] = {0, 1};
  EXPECT_EQ(loaded(maker).data.assets.size(), 1U);
}

TEST(SceneNodes, OnlyTheDefaultSceneIsLoaded) {
  GltfMaker maker = GltfMaker::triangle();
  maker.root["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {5, 0, 0}}}};
  maker.root["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
  maker.root["scene"] = 1;
  const LoadedScene scene = loaded(maker);
  ASSERT_EQ(scene.data.scene.instance_size(), 1);
  EXPECT_EQ(transform(scene)[3], 5);
}

TEST(SceneNodes, BoundsKeepTheirDigitsFarFromTheOrigin) {
  GltfMaker maker = GltfMaker::triangle();
  maker.root["nodes"][0]["translation"] = {1e9, 0.125, 0};
  const LoadedScene scene = loaded(maker);
  EXPECT_EQ(scene.data.scene.bounds_low().x(), 1e9);
  EXPECT_EQ(scene.data.scene.bounds_high().x(), 1e9 + 1);
}

// The signed area, seen from +z, of the first triangle of an instance in the world.
double area_in_world(const LoadedScene& scene) {
  const MeshArrays mesh = mesh_of(scene);
  const std::vector<double> m = transform(scene);
  const auto corner = [&](int i) {
    const glm::vec3 p = mesh.position[mesh.index[i]];
    return glm::dvec2(m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3], m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7]);
  };
  const glm::dvec2 u = corner(1) - corner(0);
  const glm::dvec2 v = corner(2) - corner(0);
  return (u.x * v.y - u.y * v.x) / 2;
}

TEST(SceneNodes, MirroredInstancesKeepCounterClockwiseFronts) {
  EXPECT_DOUBLE_EQ(area_in_world(loaded(GltfMaker::triangle())), 0.5);
  GltfMaker mirrored = GltfMaker::triangle();
  mirrored.root["nodes"][0]["scale"] = {-1, 1, 1};
  EXPECT_DOUBLE_EQ(area_in_world(loaded(mirrored)), 0.5);
  GltfMaker both = GltfMaker::triangle();
  both.root["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"scale", {-1, 1, 1}}}, {{"mesh", 0}, {"scale", {-1, -1, 1}}}};
  both.root["scenes"][0]["nodes"] = {0, 1, 2};
  const proto::Scene scene = loaded(both).data.scene;
  EXPECT_NE(scene.instance(0).mesh(), scene.instance(1).mesh());
  EXPECT_EQ(scene.instance(0).mesh(), scene.instance(2).mesh());
}

GltfMaker lit(const json& light, const json& node) {
  GltfMaker maker = GltfMaker::triangle();
  maker.root["extensionsUsed"] = {"KHR_lights_punctual"};
  maker.root["extensions"]["KHR_lights_punctual"]["lights"] = {light};
  maker.root["nodes"].push_back(node);
  maker.root["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  maker.root["scenes"][0]["nodes"] = {0, 1};
  return maker;
}

TEST(SceneLights, WithoutAnyThereAreAmbientAndHead) {
  const proto::Scene scene = loaded(GltfMaker::triangle()).data.scene;
  ASSERT_EQ(scene.light_size(), 2);
  EXPECT_EQ(scene.light(0).kind(), proto::Light::AMBIENT);
  EXPECT_THAT(scene.light(0).color(), ElementsAre(0.3F, 0.3F, 0.3F));
  EXPECT_EQ(scene.light(1).kind(), proto::Light::HEAD);
  EXPECT_THAT(scene.light(1).color(), ElementsAre(0.7F, 0.7F, 0.7F));
}

TEST(SceneLights, DirectionalShinesAlongMinusZOfItsNode) {
  const double h = std::sqrt(0.5);  // a quarter turn about x: -z becomes +y
  const GltfMaker maker = lit({{"type", "directional"}, {"intensity", std::numbers::pi}, {"color", {1, 0.5, 0}}},
                              {{"rotation", {h, 0, 0, h}}});
  const proto::Scene scene = loaded(maker).data.scene;
  ASSERT_EQ(scene.light_size(), 1);
  EXPECT_EQ(scene.light(0).kind(), proto::Light::DIRECTIONAL);
  EXPECT_THAT(scene.light(0).color(), ElementsAre(1.0F, 0.5F, 0.0F));
  EXPECT_NEAR(scene.light(0).direction().y(), 1, kRounding);
  EXPECT_NEAR(scene.light(0).direction().z(), 0, kRounding);
}

TEST(SceneLights, PointAndSpotStandAtTheirNodes) {
  const json node = {{"translation", {1, 2, 3}}};
  const proto::Scene point = loaded(lit({{"type", "point"}, {"range", 4}}, node)).data.scene;
  EXPECT_EQ(point.light(0).kind(), proto::Light::POINT);
  EXPECT_EQ(point.light(0).position().y(), 2);
  EXPECT_EQ(point.light(0).range_m(), 4);
  const json cones = {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.2}};
  const proto::Scene spot = loaded(lit({{"type", "spot"}, {"spot", cones}}, node)).data.scene;
  EXPECT_EQ(spot.light(0).kind(), proto::Light::SPOT);
  EXPECT_EQ(spot.light(0).position().z(), 3);
  EXPECT_EQ(spot.light(0).direction().z(), -1);
  EXPECT_EQ(spot.light(0).inner_cone_rad(), 0.1);
  EXPECT_EQ(spot.light(0).outer_cone_rad(), 0.2);
}

}  // namespace
}  // namespace lfd::test
