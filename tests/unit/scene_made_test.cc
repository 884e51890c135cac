// Scenes that the repository makes, and real ones from outside it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "base/hash.h"
#include "controller/scene/made/made_scenes.h"
#include "controller/scene/scene_file.h"
#include "tests/unit/gltf_maker.h"

namespace lfd::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

LoadedScene made(const std::string& name, std::uint64_t seed = 1) { return scene::make_scene(name, seed).value(); }

std::string hash_of(const LoadedScene& scene) { return content_hash(scene.data.scene.SerializeAsString()); }

TEST(SceneMade, TheSameSeedMakesTheSameScene) {
  for (const scene::MadeScene& entry : scene::made_scenes()) {
    EXPECT_EQ(hash_of(made(entry.name)), hash_of(made(entry.name))) << entry.name;
  }
  EXPECT_NE(hash_of(made("ribbed-shell", 1)), hash_of(made("ribbed-shell", 2)));
}

TEST(SceneMade, EveryMeshIsSoundAndEveryAssetIsThere) {
  for (const scene::MadeScene& entry : scene::made_scenes()) {
    const LoadedScene scene = made(entry.name);
    const Result<scene::Census> census = scene::census_of(scene.data);
    ASSERT_TRUE(census) << census.error().message();
    EXPECT_GT(census->faces, 0U);
    EXPECT_EQ(scene.data.assets.size(), census->meshes + census->pictures);
  }
}

TEST(SceneMade, TheShellHas29520Faces) {
  const LoadedScene scene = made("ribbed-shell");
  std::size_t most = 0;
  for (int i = 0; i < scene.data.scene.instance_size(); ++i) most = std::max(most, mesh_of(scene, i).index.size() / 3);
  EXPECT_EQ(most, 29520U);
  EXPECT_EQ(scene::census_of(scene.data)->pictures, 4U);
}

TEST(SceneMade, FrontsOfTheShellAgreeWithItsNormals) {
  const LoadedScene scene = made("ribbed-shell");
  for (int i = 0; i < scene.data.scene.instance_size(); ++i) {
    const MeshArrays mesh = mesh_of(scene, i);
    std::size_t against = 0;
    for (std::size_t k = 0; k < mesh.index.size(); k += 3) {
      const auto at = [&](std::size_t corner) { return mesh.position[mesh.index[k + corner]]; };
      const glm::vec3 front = glm::cross(at(1) - at(0), at(2) - at(0));
      against += glm::dot(front, mesh.normal[mesh.index[k]]) < 0 ? 1 : 0;
    }
    EXPECT_EQ(against, 0U);
  }
}

TEST(SceneMade, TheRoomIsTwelveTrianglesThatFaceInward) {
  const MeshArrays mesh = mesh_of(made("room"));
  EXPECT_EQ(mesh.index.size(), 36U);
  for (std::size_t i = 0; i < mesh.position.size(); ++i) EXPECT_LT(glm::dot(mesh.position[i], mesh.normal[i]), 0);
}

TEST(SceneMade, TheQuadFillsTheExtent) {
  const LoadedScene scene = scene::make_scene("quad", 1, {.width_m = 0.4, .height_m = 0.3}).value();
  EXPECT_FLOAT_EQ(static_cast<float>(scene.data.scene.bounds_low().x()), -0.2F);
  EXPECT_FLOAT_EQ(static_cast<float>(scene.data.scene.bounds_high().y()), 0.15F);
  EXPECT_EQ(scene.data.scene.bounds_high().z(), 0);
  EXPECT_TRUE(scene.data.scene.material(0).unlit());
}

TEST(SceneMade, UnknownNamesAndExtentsAreRefused) {
  EXPECT_THAT(scene::make_scene("shel", 1).error().message(), HasSubstr("ribbed-shell"));
  EXPECT_THAT(scene::make_scene("quad", 1, {.width_m = 0}).error().message(), HasSubstr("extent"));
}

TEST(SceneMade, WrittenScenesReadBackTheSame) {
  const Folder folder;
  for (const scene::MadeScene& entry : scene::made_scenes()) {
    const LoadedScene scene = made(entry.name);
    ASSERT_TRUE(scene::write_glb(folder.path() / "scene.glb", scene.data));
    const Result<LoadedScene> again = load_scene(folder.path() / "scene.glb");
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_THAT(again->warnings, IsEmpty());
    EXPECT_EQ(again->data.scene.instance_size(), scene.data.scene.instance_size());
    EXPECT_EQ(again->data.scene.bounds_high().SerializeAsString(), scene.data.scene.bounds_high().SerializeAsString());
    const scene::Census wanted = scene::census_of(scene.data).value();
    EXPECT_EQ(scene::census_of(again->data)->faces, wanted.faces);
    EXPECT_EQ(scene::census_of(again->data)->pictures, wanted.pictures);
  }
}

TEST(SceneMade, WrittenLightsStandWhereTheyStood) {
  const Folder folder;
  const LoadedScene scene = made("ribbed-shell");
  ASSERT_TRUE(scene::write_glb(folder.path() / "scene.glb", scene.data));
  const proto::Scene again = load_scene(folder.path() / "scene.glb").value().data.scene;
  ASSERT_EQ(again.light_size(), 2);  // without the ambient one
  const proto::Light& wanted = scene.data.scene.light(1);
  EXPECT_NEAR(again.light(0).direction().x(), wanted.direction().x(), 1e-12);  // a quaternion there and back
  EXPECT_NEAR(again.light(0).direction().y(), wanted.direction().y(), 1e-12);
  EXPECT_FLOAT_EQ(again.light(0).color(1), wanted.color(1));
  EXPECT_EQ(again.light(1).position().x(), scene.data.scene.light(2).position().x());
}

struct RealScene {
  const char* file;
  std::size_t faces;
};

class SceneReal : public ::testing::TestWithParam<RealScene> {};

TEST_P(SceneReal, HasItsFaces) {
  const char* shared = std::getenv("LFD_SHARED");
  const std::filesystem::path folder = shared != nullptr ? shared : LFD_SOURCE_DIR "/../shared";
  const std::filesystem::path file = folder / "scenes" / GetParam().file;
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not here";
  const Result<LoadedScene> scene = load_scene(file);
  ASSERT_TRUE(scene) << scene.error().message();
  EXPECT_EQ(scene::census_of(scene->data)->faces, GetParam().faces);
}

INSTANTIATE_TEST_SUITE_P(All, SceneReal,
                         ::testing::Values(RealScene{"sponza/Sponza.gltf", 262267}, RealScene{"armadillo.glb", 99976},
                                           RealScene{"dragon.glb", 100000}, RealScene{"viking_room.glb", 3828}),
                         [](const auto& test) { return std::filesystem::path(test.param.file).stem().string(); });

}  // namespace
}  // namespace lfd::test
