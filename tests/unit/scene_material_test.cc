// Materials and textures of glTF files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/gltf_maker.h"

namespace lfd::test {
namespace {

using ::testing::ElementsAre;
using ::testing::FloatNear;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pointwise;

// A triangle with two sets of texture coordinates and a textured material.
GltfMaker textured() {
  GltfMaker maker = GltfMaker::triangle();
  maker.primitive()["attributes"]["TEXCOORD_0"] = maker.add_floats({0, 0, 1, 0, 0, 1}, "VEC2");
  maker.primitive()["attributes"]["TEXCOORD_1"] = maker.add_floats({.5F, .5F, 1, .5F, .5F, 1}, "VEC2");
  maker.material()["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  maker.root["textures"] = {{{"source", 0}}};
  maker.root["images"] = {{{"uri", "data:image/png;base64," + base64(tiny_png())}}};
  return maker;
}

json& texture_info(GltfMaker& maker) { return maker.material()["pbrMetallicRoughness"]["baseColorTexture"]; }

const proto::Material& material_of(const LoadedScene& scene) {
  return scene.data.scene.material(static_cast<int>(scene.data.scene.instance(0).material()));
}

TEST(SceneMaterial, WithoutOneItIsWhiteOpaqueSingleSidedAndLit) {
  const LoadedScene scene = loaded(GltfMaker::triangle());
  const proto::Material& material = material_of(scene);
  EXPECT_THAT(material.base_color(), ElementsAre(1, 1, 1, 1));
  EXPECT_FALSE(material.has_texture() || material.has_alpha_cutoff() || material.double_sided() || material.unlit());
}

TEST(SceneMaterial, FactorMaskSidesAndUnlitAreRead) {
  GltfMaker maker = GltfMaker::triangle();
  maker.root["extensionsUsed"] = {"KHR_materials_unlit"};
  maker.material() = {{"name", "leaf"}, {"alphaMode", "MASK"}, {"alphaCutoff", 0.25}, {"doubleSided", true}};
  maker.material()["extensions"]["KHR_materials_unlit"] = json::object();
  maker.material()["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.25, 0.125, 1.0};
  const LoadedScene scene = loaded(maker);
  const proto::Material& material = material_of(scene);
  EXPECT_EQ(material.name(), "leaf");
  EXPECT_THAT(material.base_color(), ElementsAre(0.5F, 0.25F, 0.125F, 1.0F));
  EXPECT_EQ(material.alpha_cutoff(), 0.25F);
  EXPECT_TRUE(material.double_sided());
  EXPECT_TRUE(material.unlit());
  EXPECT_THAT(scene.warnings, IsEmpty());
}

TEST(SceneMaterial, BlendingIsDrawnOpaqueWithAWarning) {
  GltfMaker maker = GltfMaker::triangle();
  maker.material()["alphaMode"] = "BLEND";
  const LoadedScene scene = loaded(maker);
  EXPECT_FALSE(material_of(scene).has_alpha_cutoff());
  EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("alpha blending")));
}

TEST(SceneMaterial, PicturesTravelAsTheyCame) {
  const LoadedScene scene = loaded(textured());
  proto::Picture picture;
  ASSERT_TRUE(picture.ParseFromString(*scene.data.assets.at(material_of(scene).texture().picture())));
  EXPECT_EQ(picture.file(), tiny_png());
}

TEST(SceneMaterial, PicturesInBufferViewsAndInFilesAreTheSame) {
  const std::string inline_hash = material_of(loaded(textured())).texture().picture();
  GltfMaker in_view = textured();
  in_view.root["images"] = {{{"bufferView", in_view.add_view(tiny_png())}, {"mimeType", "image/png"}}};
  EXPECT_EQ(material_of(loaded(in_view)).texture().picture(), inline_hash);
  GltfMaker in_file = textured();
  in_file.root["images"] = {{{"uri", "a%20b.png"}}};
  const Folder folder;
  folder.write("a b.png", tiny_png());
  const Result<LoadedScene> scene = load_scene(folder.write("scene.gltf", in_file.gltf()));
  ASSERT_TRUE(scene) << scene.error().message();
  EXPECT_EQ(material_of(*scene).texture().picture(), inline_hash);
}

TEST(SceneMaterial, SamplersSayHowTexturesWrap) {
  GltfMaker maker = textured();
  EXPECT_EQ(material_of(loaded(maker)).texture().wrap_s(), proto::Texture::REPEAT);
  maker.root["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
  maker.root["textures"][0]["sampler"] = 0;
  const proto::Texture texture = material_of(loaded(maker)).texture();
  EXPECT_EQ(texture.wrap_s(), proto::Texture::CLAMP_TO_EDGE);
  EXPECT_EQ(texture.wrap_t(), proto::Texture::MIRRORED_REPEAT);
  EXPECT_TRUE(texture.nearest());
}

TEST(SceneMaterial, TheTextureNamesItsSetOfCoordinates) {
  GltfMaker maker = textured();
  EXPECT_EQ(mesh_of(loaded(maker)).uv[0], glm::vec2(0, 0));
  texture_info(maker)["texCoord"] = 1;
  EXPECT_EQ(mesh_of(loaded(maker)).uv[0], glm::vec2(.5F, .5F));
  texture_info(maker)["texCoord"] = 0;
  texture_info(maker)["extensions"]["KHR_texture_transform"]["texCoord"] = 1;
  EXPECT_EQ(mesh_of(loaded(maker)).uv[0], glm::vec2(.5F, .5F));
}

TEST(SceneMaterial, ATextureWithoutItsCoordinatesIsWarnedOf) {
  GltfMaker maker = textured();
  texture_info(maker)["texCoord"] = 5;
  EXPECT_THAT(loaded(maker).warnings, ElementsAre(HasSubstr("mesh 0 \"curtain\": primitive 0")));
}

// The example of the extension's text: only the lower left quadrant of the image is used, turned.
TEST(SceneMaterial, TextureTransformTurnsAsItsSpecificationSays) {
  GltfMaker maker = textured();
  texture_info(maker)["extensions"]["KHR_texture_transform"] = {
      {"offset", {0, 1}}, {"rotation", std::numbers::pi / 2}, {"scale", {0.5, 0.5}}};
  const proto::Texture texture = material_of(loaded(maker)).texture();
  EXPECT_THAT(texture.uv_transform(), Pointwise(FloatNear(1e-6F), {0.0F, 0.5F, 0.0F, -0.5F, 0.0F, 1.0F}));
}

TEST(SceneMaterial, UnusedTexturesMayBeMissing) {
  GltfMaker maker = textured();
  maker.root["images"].push_back({{"uri", "missing.png"}});
  maker.root["textures"].push_back({{"source", 1}});
  maker.material()["normalTexture"] = {{"index", 1}};
  EXPECT_THAT(loaded(maker).warnings, ElementsAre(HasSubstr("normal textures")));
}

TEST(SceneMaterial, UnsupportedThingsAreNamedInOneWarning) {
  GltfMaker maker = GltfMaker::triangle();
  maker.root["extensionsUsed"] = {"KHR_materials_clearcoat", "KHR_materials_unlit"};
  maker.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}}}}};
  maker.root["skins"] = {{{"joints", {0}}}};
  maker.root["animations"] = {
      {{"samplers", json::array()}, {"channels", {{{"sampler", 0}, {"target", {{"path", "pointer"}}}}}}}};
  maker.primitive()["targets"] = {{{"POSITION", 0}}};
  EXPECT_THAT(loaded(maker).warnings,
              ElementsAre("not supported and left out: KHR_materials_clearcoat, cameras, morph targets, skins"));
}

}  // namespace
}  // namespace lfd::test
