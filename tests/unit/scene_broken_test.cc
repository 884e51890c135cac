// Broken scene files: an error that names the place, never a crash.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/unit/gltf_maker.h"

namespace lfd::test {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;

// A triangle with everything: indices, colours, texture, animation, light.
GltfMaker everything() {
  GltfMaker maker = GltfMaker::triangle();
  json& attributes = maker.primitive()["attributes"];
  attributes["NORMAL"] = maker.add_floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  attributes["TEXCOORD_0"] = maker.add_floats({0, 0, 1, 0, 0, 1}, "VEC2");
  attributes["COLOR_0"] = maker.add_floats({1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}, "VEC4");
  maker.primitive()["indices"] = maker.add_accessor<std::uint16_t>({0, 1, 2}, kUnsignedShort, "SCALAR", 3);
  maker.material()["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  maker.root["textures"] = {{{"source", 0}, {"sampler", 0}}};
  maker.root["samplers"] = {{{"wrapS", 33071}}};
  maker.root["images"] = {{{"bufferView", maker.add_view(tiny_png())}, {"mimeType", "image/png"}}};
  maker.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}, {"spot", json::object()}}};
  maker.root["nodes"].push_back({{"children", {2}}});
  maker.root["nodes"].push_back({{"mesh", 0}, {"scale", {-1, 2, 1}}});
  maker.root["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  maker.root["scenes"][0]["nodes"] = {0, 1};
  const int input = maker.add_floats({0, 1}, "SCALAR");
  const int output = maker.add_floats({0, 0, 0, 1, 0, 0, 0, 1}, "VEC4");
  maker.root["animations"] = {{{"samplers", {{{"input", input}, {"output", output}}}},
                               {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}}}}};
  return maker;
}

TEST(SceneBroken, TheUnbrokenFileLoads) {
  const Result<LoadedScene> glb = load_bytes(everything().glb());
  EXPECT_TRUE(glb) << glb.error().message();
}

TEST(SceneBroken, ErrorsStartWithTheFileAndNameThePlace) {
  GltfMaker maker = GltfMaker::triangle();
  maker.primitive()["attributes"]["POSITION"] = 17;
  EXPECT_THAT(
      error_of(maker),
      EndsWith(
          "/test.gltf: node 0 \"stand\": mesh 0 \"curtain\": primitive 0: POSITION: accessor 17 does not exist; there "
          "are 1"));
}

struct Case {
  const char* name;
  void (*damage)(GltfMaker& maker);
  const char* place;  // a part of the error
};

void set_buffer_uri(GltfMaker& maker, const std::string& uri) {
  maker.root["buffers"] = {{{"byteLength", maker.binary.size()}, {"uri", uri}}};
}

const Case kCases[] = {
    {"AccessorBeyondView", [](GltfMaker& m) { m.root["accessors"][0]["count"] = 4; },
     "primitive 0: POSITION: accessor 0: 4 elements"},
    {"AccessorOffsetBeyondView", [](GltfMaker& m) { m.root["accessors"][0]["byteOffset"] = 18446744073709551615U; },
     "accessor 0"},
    {"AbsurdCount", [](GltfMaker& m) { m.root["accessors"][0]["count"] = 18446744073709551615U; }, "at most"},
    {"AbsurdSparseCount",
     [](GltfMaker& m) {
       m.root["accessors"][0] = {{"componentType", kFloat},
                                 {"type", "VEC3"},
                                 {"count", 1000000000000},
                                 {"sparse",
                                  {{"count", 1},
                                   {"indices", {{"bufferView", 0}, {"componentType", kUnsignedInt}}},
                                   {"values", {{"bufferView", 0}}}}}};
     },
     "at most"},
    {"NoElements", [](GltfMaker& m) { m.root["accessors"][0]["count"] = 0; }, "accessor 0: count"},
    {"WrongComponents", [](GltfMaker& m) { m.root["accessors"][0]["type"] = "VEC4"; }, "accessor 0: 4 components"},
    {"ForeignComponentType", [](GltfMaker& m) { m.root["accessors"][0]["componentType"] = 5130; },
     "componentType 5130"},
    {"ViewBeyondBuffer", [](GltfMaker& m) { m.root["bufferViews"][0]["byteLength"] = 1000000; },
     "bufferView 0: bytes 0 + 1000000"},
    {"ViewOffsetBeyondBuffer", [](GltfMaker& m) { m.root["bufferViews"][0]["byteOffset"] = 18446744073709551610U; },
     "bufferView 0"},
    {"ViewOfNoBuffer", [](GltfMaker& m) { m.root["bufferViews"][0]["buffer"] = 3; }, "buffer 3 does not exist"},
    {"StrideTooSmall", [](GltfMaker& m) { m.root["bufferViews"][0]["byteStride"] = 4; }, "byteStride 4"},
    {"IndexOutOfRange",
     [](GltfMaker& m) {
       m.primitive()["indices"] = m.add_accessor<std::uint8_t>({0, 1, 3}, kUnsignedByte, "SCALAR", 3);
     },
     "indices: accessor 7: index 3 of 3 vertices"},
    {"FloatIndices",
     [](GltfMaker& m) {
       m.primitive()["indices"] = m.add_floats({0, 1, 2}, "SCALAR");
     },
     "unsigned integers"},
    {"NaNPosition",
     [](GltfMaker& m) {
       m.primitive()["attributes"]["POSITION"] = m.add_floats({0, 0, 0, 1, NAN, 0, 0, 1, 0}, "VEC3");
     },
     "POSITION: accessor 7: vertex 1 is not finite"},
    {"InfinitePosition",
     [](GltfMaker& m) {
       m.primitive()["attributes"]["POSITION"] = m.add_floats({0, 0, 0, 1, 0, 0, 0, INFINITY, 0}, "VEC3");
     },
     "vertex 2 is not finite"},
    {"TooFewNormals",
     [](GltfMaker& m) {
       m.primitive()["attributes"]["NORMAL"] = m.add_floats({0, 0, 1}, "VEC3");
     },
     "NORMAL: 1 values for 3 vertices"},
    {"NoPosition", [](GltfMaker& m) { m.primitive()["attributes"].erase("POSITION"); }, "POSITION is missing"},
    {"NoAttributes", [](GltfMaker& m) { m.primitive().erase("attributes"); }, "attributes"},
    {"ForeignMode", [](GltfMaker& m) { m.primitive()["mode"] = 9; }, "mode 9"},
    {"MaterialOutOfRange", [](GltfMaker& m) { m.primitive()["material"] = 5; }, "material 5 does not exist"},
    {"TextureOutOfRange", [](GltfMaker& m) { m.material()["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 5; },
     "material 0: baseColorTexture: texture 5"},
    {"ImageOutOfRange", [](GltfMaker& m) { m.root["textures"][0]["source"] = 5; }, "image 5 does not exist"},
    {"SamplerOutOfRange", [](GltfMaker& m) { m.root["textures"][0]["sampler"] = 5; }, "sampler 5 does not exist"},
    {"ImageOfAnotherKind",
     [](GltfMaker& m) {
       m.root["images"] = {{{"bufferView", m.add_view("GIF89a")}, {"mimeType", "image/png"}}};
     },
     "image 0: neither PNG nor JPEG"},
    {"ImageThatCannotBeDecoded",
     [](GltfMaker& m) {
       const std::string cut = tiny_png().substr(0, 40);
       m.root["images"] = {{{"bufferView", m.add_view(cut)}, {"mimeType", "image/png"}}};
     },
     "material 0: baseColorTexture: texture 0: image 0: "},
    {"ImageViewBeyondBuffer", [](GltfMaker& m) { m.root["bufferViews"][5]["byteLength"] = 1000000; },
     "image 0: bufferView 5"},
    {"ImageMissing",
     [](GltfMaker& m) {
       m.root["images"] = {{{"uri", "missing.png"}}};
     },
     "\"missing.png\": No such file"},
    {"MeshOutOfRange", [](GltfMaker& m) { m.root["nodes"][0]["mesh"] = 5; }, "node 0 \"stand\": mesh 5 does not exist"},
    {"NegativeMesh", [](GltfMaker& m) { m.root["nodes"][0]["mesh"] = -7; }, "mesh -7 does not exist"},
    {"ChildOutOfRange", [](GltfMaker& m) { m.root["nodes"][0]["children"] = {9}; },
     "node 0 \"stand\": children: node 9"},
    {"RootOutOfRange", [](GltfMaker& m) { m.root["scenes"][0]["nodes"] = {9}; }, "scene 0: node 9"},
    {"SceneOutOfRange", [](GltfMaker& m) { m.root["scene"] = 9; }, "scene 9 does not exist"},
    {"CycleOfOne", [](GltfMaker& m) { m.root["nodes"][0]["children"] = {0}; }, "cycle"},
    {"CycleOfTwo", [](GltfMaker& m) { m.root["nodes"][2]["children"] = {1}; }, "cycle"},
    {"TwoParents", [](GltfMaker& m) { m.root["nodes"][0]["children"] = {2}; }, "must be a tree"},
    {"RootTwice",
     [](GltfMaker& m) {
       m.root["scenes"][0]["nodes"] = {0, 0};
     },
     "in the scene twice"},
    {"ShortMatrix",
     [](GltfMaker& m) {
       m.root["nodes"][0]["matrix"] = {1, 2, 3};
     },
     "node 0 \"stand\": matrix"},
    {"ZeroRotation",
     [](GltfMaker& m) {
       m.root["nodes"][0]["rotation"] = {0, 0, 0, 0};
     },
     "rotation"},
    {"OverflowingTransform",
     [](GltfMaker& m) {
       m.root["nodes"][1]["scale"] = {1e300, 1, 1};
       m.root["nodes"][2]["scale"] = {1e300, 1, 1};
     },
     "not finite"},
    {"LightOutOfRange", [](GltfMaker& m) { m.root["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 4; },
     "light 4 does not exist"},
    {"AnimatedNodeOutOfRange", [](GltfMaker& m) { m.root["animations"][0]["channels"][0]["target"]["node"] = 9; },
     "animation 0: channel 0: node 9"},
    {"AnimationSamplerOutOfRange", [](GltfMaker& m) { m.root["animations"][0]["channels"][0]["sampler"] = 9; },
     "sampler 9"},
    {"RequiredExtension", [](GltfMaker& m) { m.root["extensionsRequired"] = {"KHR_draco_mesh_compression"}; },
     "KHR_draco_mesh_compression is required"},
    {"OtherVersion", [](GltfMaker& m) { m.root["asset"]["version"] = "1.0"; }, "version"},
    {"NothingToDraw", [](GltfMaker& m) { m.root["scenes"][0]["nodes"] = json::array(); }, "nothing to draw"},
    {"BufferMissing", [](GltfMaker& m) { set_buffer_uri(m, "missing.bin"); }, "\"missing.bin\": No such file"},
    {"BufferOutsideTheFolder", [](GltfMaker& m) { set_buffer_uri(m, "../secret.bin"); },
     "\"../secret.bin\": leaves the scene's folder"},
    {"BufferAtAnAbsolutePath", [](GltfMaker& m) { set_buffer_uri(m, "/etc/hostname"); }, "leaves the scene's folder"},
    {"BufferIsAFolder", [](GltfMaker& m) { set_buffer_uri(m, "."); }, "is not a regular file"},
};

class SceneBrokenCase : public ::testing::TestWithParam<Case> {};

TEST_P(SceneBrokenCase, IsRefusedByName) {
  GltfMaker maker = everything();
  GetParam().damage(maker);
  EXPECT_THAT(error_of(maker), AllOf(HasSubstr("/test.gltf: "), HasSubstr(GetParam().place)));
}

INSTANTIATE_TEST_SUITE_P(All, SceneBrokenCase, ::testing::ValuesIn(kCases),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(SceneBroken, LinksOutOfTheFolderAreRefused) {
  const Folder outside;
  outside.write("data.bin", std::string(36, '\0'));
  const Folder folder;
  std::filesystem::create_symlink(outside.path() / "data.bin", folder.path() / "link.bin");
  GltfMaker maker = GltfMaker::triangle();
  maker.root["buffers"] = {{{"byteLength", 36}, {"uri", "link.bin"}}};
  std::filesystem::create_directories(folder.path() / "scene");
  std::filesystem::create_symlink(folder.path() / "link.bin", folder.path() / "scene" / "link.bin");
  const Result<LoadedScene> scene = load_scene(folder.write("scene/test.gltf", maker.gltf()));
  ASSERT_FALSE(scene);
  EXPECT_THAT(scene.error().message(), HasSubstr("leaves the scene's folder"));
}

TEST(SceneBroken, OtherFilesAreNotGltf) {
  for (const std::string& content : {std::string(), std::string("hello"), std::string("[1,2]"), std::string("{}"),
                                     std::string("glTF"), std::string(100, '\0'), tiny_png()}) {
    const Result<LoadedScene> scene = load_bytes(content);
    ASSERT_FALSE(scene);
    EXPECT_THAT(scene.error().message(), HasSubstr("/test.gltf: "));
  }
  EXPECT_FALSE(load_scene("no/such/file.glb"));
}

TEST(SceneBroken, DeepNestingIsRefused) {
  GltfMaker maker = GltfMaker::triangle();
  std::string text = maker.gltf();
  std::string deep = "\"extras\":";
  deep.append(200000, '[').append(200000, ']').append(",");
  text.insert(1, deep);
  const Result<LoadedScene> scene = load_bytes(text);
  ASSERT_FALSE(scene);
  EXPECT_THAT(scene.error().message(), HasSubstr("nested"));
}

TEST(SceneBroken, LongChainsOfNodesLoad) {
  GltfMaker maker = GltfMaker::triangle();
  constexpr int kNodes = 50000;
  maker.root["nodes"] = json::array();
  for (int i = 0; i < kNodes - 1; ++i) maker.root["nodes"].push_back({{"children", {i + 1}}});
  maker.root["nodes"].push_back({{"mesh", 0}});
  EXPECT_EQ(loaded(maker).data.scene.instance_size(), 1);
}

TEST(SceneBroken, WhatIsNoGltfIsToldSoInWords) {
  EXPECT_THAT(load_bytes("").error().message(), HasSubstr("the file is empty"));
  EXPECT_THAT(load_bytes("hello\n").error().message(), HasSubstr("neither glTF (JSON) nor glb"));
}

TEST(SceneBroken, EveryTruncationOfAGlbIsRefused) {
  const std::string whole = everything().glb();
  for (std::size_t size = 0; size < whole.size(); size += 7) EXPECT_FALSE(load_bytes(whole.substr(0, size))) << size;
}

// Bytes and JSON tokens changed at random, always the same way: whatever comes of it, it is a scene or an error.
TEST(SceneBroken, MutationsNeverCrash) {
  std::mt19937 random(20);
  const auto below = [&](std::size_t limit) {
    return std::uniform_int_distribution<std::size_t>(0, limit - 1)(random);
  };
  const std::string tokens[] = {"-1", "0", "1", "4294967296", "1e308", "null", "[]", "{}", "\"\"", "true", "0.5", "99"};
  const std::string whole[] = {everything().glb(), everything().gltf()};
  const Folder folder;
  int scenes = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string content = whole[round % 2];
    for (std::size_t change = 0; change <= below(4); ++change) {
      const std::size_t at = below(content.size());
      if (round % 3 == 0) {
        content[at] = static_cast<char>(below(256));
      } else if (round % 3 == 1) {
        const std::size_t digit = content.find_first_of("0123456789", at);
        if (digit != std::string::npos) content[digit] = static_cast<char>('0' + below(10));
      } else {
        const std::size_t colon = content.find(':', at);
        const std::size_t end = colon == std::string::npos ? colon : content.find_first_of(",}]", colon);
        if (end != std::string::npos) content.replace(colon + 1, end - colon - 1, tokens[below(std::size(tokens))]);
      }
    }
    const Result<LoadedScene> scene = load_scene(folder.write("mutant.glb", content));
    scenes += scene ? 1 : 0;
    if (!scene) {
      EXPECT_FALSE(scene.error().message().empty());
    }
  }
  EXPECT_GT(scenes, 0);
}

}  // namespace
}  // namespace lfd::test
