// Meshes of glTF files: every layout that numbers may have comes out as the same triangles.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/gltf_maker.h"

namespace lfd::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

const std::vector<float> kSquare = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

GltfMaker square() {
  GltfMaker maker = GltfMaker::triangle();
  maker.primitive()["attributes"]["POSITION"] = maker.add_floats(kSquare, "VEC3");
  maker.primitive()["attributes"]["NORMAL"] = maker.add_floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  return maker;
}

TEST(SceneMesh, NotIndexedTriangleGetsItsFlatNormal) {
  const MeshArrays mesh = mesh_of(loaded(GltfMaker::triangle()));
  EXPECT_THAT(mesh.position, ElementsAre(glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)));
  EXPECT_THAT(mesh.normal, ElementsAre(glm::vec3(0, 0, 1), glm::vec3(0, 0, 1), glm::vec3(0, 0, 1)));
  EXPECT_THAT(mesh.index, ElementsAre(0U, 1U, 2U));
  EXPECT_THAT(mesh.uv, SizeIs(0));
  EXPECT_THAT(mesh.color, SizeIs(0));
}

TEST(SceneMesh, IndicesOfEveryTypeAreTheSame) {
  const std::vector<std::uint32_t> wanted = {0, 1, 2, 0, 2, 3};
  GltfMaker bytes = square();
  bytes.primitive()["indices"] = bytes.add_accessor<std::uint8_t>({0, 1, 2, 0, 2, 3}, kUnsignedByte, "SCALAR", 6);
  GltfMaker shorts = square();
  shorts.primitive()["indices"] = shorts.add_accessor<std::uint16_t>({0, 1, 2, 0, 2, 3}, kUnsignedShort, "SCALAR", 6);
  GltfMaker ints = square();
  ints.primitive()["indices"] = ints.add_accessor(wanted, kUnsignedInt, "SCALAR", 6);
  for (const GltfMaker& maker : {bytes, shorts, ints}) EXPECT_EQ(mesh_of(loaded(maker)).index, wanted);
}

TEST(SceneMesh, FlatNormalsSplitSharedVertices) {
  GltfMaker maker = GltfMaker::triangle();  // two triangles over one edge, at a right angle
  maker.primitive()["attributes"]["POSITION"] = maker.add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, -1}, "VEC3");
  maker.primitive()["indices"] = maker.add_accessor<std::uint8_t>({0, 1, 2, 0, 3, 1}, kUnsignedByte, "SCALAR", 6);
  const MeshArrays mesh = mesh_of(loaded(maker));
  ASSERT_THAT(mesh.position, SizeIs(6));
  for (int i = 0; i < 3; ++i) EXPECT_EQ(mesh.normal[i], glm::vec3(0, 0, 1));
  for (int i = 3; i < 6; ++i) EXPECT_EQ(mesh.normal[i], glm::vec3(0, -1, 0));
}

TEST(SceneMesh, StripsAndFansKeepTheFront) {
  GltfMaker strip = square();
  strip.primitive()["mode"] = 5;
  strip.primitive()["indices"] = strip.add_accessor<std::uint8_t>({0, 1, 3, 2}, kUnsignedByte, "SCALAR", 4);
  EXPECT_THAT(mesh_of(loaded(strip)).index, ElementsAre(0U, 1U, 3U, 1U, 2U, 3U));
  GltfMaker fan = square();
  fan.primitive()["mode"] = 6;
  EXPECT_THAT(mesh_of(loaded(fan)).index, ElementsAre(1U, 2U, 0U, 2U, 3U, 0U));
}

TEST(SceneMesh, PointsAndLinesAreNamedAndLeftOut) {
  GltfMaker maker = GltfMaker::triangle();
  json lines = maker.primitive();
  lines["mode"] = 1;
  maker.root["meshes"][0]["primitives"].push_back(lines);
  const LoadedScene scene = loaded(maker);
  EXPECT_EQ(scene.data.scene.instance_size(), 1);
  EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("lines")));
}

TEST(SceneMesh, InterleavedArraysAreRead) {
  GltfMaker maker = GltfMaker::triangle();
  const std::vector<float> mixed = {0, 0, 0, .1F, .2F, 1, 0, 0, .3F, .4F, 0, 1, 0, .5F, .6F};
  const int view = maker.add_view(bytes_of(mixed), 20);
  maker.primitive()["attributes"] = {{"POSITION", maker.add_accessor_of(view, kFloat, "VEC3", 3)},
                                     {"TEXCOORD_0", maker.add_accessor_of(view, kFloat, "VEC2", 3, 12)}};
  maker.material()["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  maker.root["textures"] = {{{"source", 0}}};
  maker.root["images"] = {{{"uri", "data:image/png;base64," + base64(tiny_png())}}};
  const MeshArrays mesh = mesh_of(loaded(maker));
  EXPECT_THAT(mesh.position, ElementsAre(glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)));
  EXPECT_THAT(mesh.uv, ElementsAre(glm::vec2(.1F, .2F), glm::vec2(.3F, .4F), glm::vec2(.5F, .6F)));
}

TEST(SceneMesh, NormalizedIntegersBecomeColors) {
  GltfMaker bytes = GltfMaker::triangle();  // three components of a byte, padded to four
  const int view = bytes.add_view(bytes_of<std::uint8_t>({255, 0, 51, 0, 0, 255, 0, 0, 0, 0, 255, 0}), 4);
  const int color = bytes.add_accessor_of(view, kUnsignedByte, "VEC3", 3);
  bytes.root["accessors"][color]["normalized"] = true;
  bytes.primitive()["attributes"]["COLOR_0"] = color;
  EXPECT_EQ(mesh_of(loaded(bytes)).color[0], glm::vec4(1, 0, 0.2F, 1));

  GltfMaker shorts = GltfMaker::triangle();
  const int color4 =
      shorts.add_accessor<std::uint16_t>({65535, 0, 13107, 32768, 0, 0, 0, 0, 0, 0, 0, 0}, kUnsignedShort, "VEC4", 3);
  shorts.root["accessors"][color4]["normalized"] = true;
  shorts.primitive()["attributes"]["COLOR_0"] = color4;
  EXPECT_EQ(mesh_of(loaded(shorts)).color[0], glm::vec4(1, 0, 0.2F, 32768.0F / 65535.0F));
}

TEST(SceneMesh, SignedIntegersOfQuantizedMeshesAreRead) {
  GltfMaker maker = GltfMaker::triangle();
  maker.root["extensionsRequired"] = {"KHR_mesh_quantization"};
  const int position = maker.add_accessor_of(
      maker.add_view(bytes_of<std::int16_t>({0, 0, 0, 0, 300, 0, 0, 0, 0, -200, 0, 0}), 8), kShort, "VEC3", 3);
  const int normal = maker.add_accessor_of(
      maker.add_view(bytes_of<std::int8_t>({0, 0, -128, 0, 0, 0, -127, 0, 0, 0, -64, 0}), 4), kByte, "VEC3", 3);
  maker.root["accessors"][normal]["normalized"] = true;
  maker.primitive()["attributes"] = {{"POSITION", position}, {"NORMAL", normal}};
  const MeshArrays mesh = mesh_of(loaded(maker));
  EXPECT_THAT(mesh.position, ElementsAre(glm::vec3(0), glm::vec3(300, 0, 0), glm::vec3(0, -200, 0)));
  EXPECT_THAT(mesh.normal, ElementsAre(glm::vec3(0, 0, -1), glm::vec3(0, 0, -1), glm::vec3(0, 0, -1)));
}

TEST(SceneMesh, SparseValuesReplaceOthersOrZeros) {
  GltfMaker over = GltfMaker::triangle();
  const json sparse = {
      {"count", 1},
      {"indices", {{"bufferView", over.add_view(bytes_of<std::uint16_t>({2}))}, {"componentType", kUnsignedShort}}},
      {"values", {{"bufferView", over.add_view(bytes_of<float>({0, 7, 0}))}}}};
  over.root["accessors"][0]["sparse"] = sparse;
  EXPECT_THAT(mesh_of(loaded(over)).position, ElementsAre(glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 7, 0)));

  GltfMaker zeros = GltfMaker::triangle();
  zeros.root["accessors"][0] = {{"componentType", kFloat}, {"type", "VEC3"}, {"count", 3}};
  zeros.root["accessors"][0]["sparse"] = {
      {"count", 2},
      {"indices", {{"bufferView", zeros.add_view(bytes_of<std::uint8_t>({1, 2}))}, {"componentType", kUnsignedByte}}},
      {"values", {{"bufferView", zeros.add_view(bytes_of<float>({5, 0, 0, 0, 6, 0}))}}}};
  EXPECT_THAT(mesh_of(loaded(zeros)).position, ElementsAre(glm::vec3(0), glm::vec3(5, 0, 0), glm::vec3(0, 6, 0)));
}

TEST(SceneMesh, BrokenNormalsAreMended) {
  GltfMaker maker = GltfMaker::triangle();
  maker.primitive()["attributes"]["NORMAL"] = maker.add_floats({0, 0, 0, 0, NAN, 0, 0, 3, 4}, "VEC3");
  EXPECT_THAT(mesh_of(loaded(maker)).normal,
              ElementsAre(glm::vec3(0, 0, 1), glm::vec3(0, 0, 1), glm::vec3(0, .6F, .8F)));
}

TEST(SceneMesh, ColoursThatAreNoNumbersAreMendedWithAWarning) {
  GltfMaker maker = GltfMaker::triangle();
  maker.primitive()["attributes"]["COLOR_0"] = maker.add_floats({1, NAN, 0, 0, INFINITY, 0.5F, 1, 1, 1}, "VEC3");
  const LoadedScene scene = loaded(maker);
  EXPECT_THAT(mesh_of(scene).color,
              ElementsAre(glm::vec4(1, 0, 0, 1), glm::vec4(0, 0, 0.5F, 1), glm::vec4(1, 1, 1, 1)));
  EXPECT_THAT(scene.warnings,
              ElementsAre(testing::HasSubstr("2 texture coordinates or vertex colours are not finite")));
}

TEST(SceneMesh, GlbIsTheSameAsGltf) {
  const GltfMaker maker = GltfMaker::triangle();
  const Result<LoadedScene> glb = load_bytes(maker.glb(), "test.glb");
  ASSERT_TRUE(glb) << glb.error().message();
  EXPECT_EQ(glb->data.scene.SerializeAsString(), loaded(maker).data.scene.SerializeAsString());
}

}  // namespace
}  // namespace lfd::test
