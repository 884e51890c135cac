// Files that a scene names: only those of its own folder are read, however the name is written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "base/log.h"
#include "base/temporary_folder.h"
#include "tests/unit/gltf_maker.h"

namespace lfd::test {
namespace {

namespace fs = std::filesystem;
using testing::AnyOf;
using testing::HasSubstr;

// A scene's folder beside a file that it has no business with; both files would do as the scene's buffer.
class ScenePaths : public testing::Test {
 protected:
  ScenePaths() {
    fs::create_directories(scene_ / "inner");
    for (const fs::path& path : {secret_, scene_ / "own.bin", scene_ / "inner" / "own.bin", scene_ / "a%2e.bin"})
      EXPECT_TRUE(write_file(path, maker_.binary));
  }

  // Loads the scene with this name of its buffer; the error, empty where it loads.
  std::string load(const std::string& uri) {
    maker_.root["buffers"] = {{{"byteLength", maker_.binary.size()}, {"uri", uri}}};
    EXPECT_TRUE(write_file(scene_ / "test.gltf", maker_.root.dump()));
    const Result<LoadedScene> scene = load_scene(scene_ / "test.gltf");
    return scene ? "" : scene.error().message();
  }

  TemporaryFolder folder_ = *TemporaryFolder::make("lfd-paths");
  const fs::path scene_ = folder_.path() / "scene", secret_ = folder_.path() / "secret.bin";
  GltfMaker maker_ = GltfMaker::triangle();
};

TEST_F(ScenePaths, FilesOfTheFolderAreRead) {
  for (const char* const uri : {"own.bin", "./own.bin", "inner/own.bin", "inner/../own.bin", "inner/./../own.bin",
                                "o%77n.bin", "inner%2Fown.bin", "a%252e.bin"})
    EXPECT_EQ(load(uri), "") << uri;
}

TEST_F(ScenePaths, NothingElseIs) {
  const std::string secret = secret_.string();
  for (const std::string& uri : {std::string("../secret.bin"),
                                 std::string("./../secret.bin"),
                                 std::string("inner/../../secret.bin"),
                                 std::string("..//secret.bin"),
                                 std::string("../scene/../secret.bin"),
                                 secret,
                                 "/" + secret,
                                 "//" + secret,
                                 "file://" + secret,
                                 "FILE://" + secret,
                                 "file:" + secret,
                                 "file://localhost" + secret,
                                 std::string("%2e%2e/secret.bin"),
                                 std::string("%2E%2E%2Fsecret.bin"),
                                 std::string("..%2fsecret.bin"),
                                 std::string("%252e%252e/secret.bin"),
                                 std::string(".%2e/secret.bin"),
                                 std::string("..\\secret.bin"),
                                 std::string("..%5csecret.bin"),
                                 std::string("~/secret.bin"),
                                 std::string("$HOME/secret.bin"),
                                 std::string("http://127.0.0.1/secret.bin"),
                                 std::string("../scene/own.bin/../../secret.bin")})
    EXPECT_THAT(load(uri), AnyOf(HasSubstr("leaves the scene's folder"), HasSubstr("No such file"))) << uri;
}

TEST_F(ScenePaths, ANameWithAZeroIsNoFiles) {
  for (const char* const uri : {"own.bin%00", "own.bin%00/../../secret.bin", "%00"})
    EXPECT_THAT(load(uri), HasSubstr("the name is no file's")) << uri;
  EXPECT_NE(load(std::string("own.bin\0x", 9)), "");
}

TEST_F(ScenePaths, LinksThatLeaveAreRefusedAndThoseThatStayAreFollowed) {
  fs::create_symlink(secret_, scene_ / "link.bin");
  fs::create_symlink("../secret.bin", scene_ / "relative.bin");
  fs::create_symlink("..", scene_ / "up");
  fs::create_symlink("own.bin", scene_ / "stays.bin");
  fs::create_symlink("loop.bin", scene_ / "loop.bin");
  for (const char* const uri : {"link.bin", "relative.bin", "up/secret.bin", "inner/../up/secret.bin"})
    EXPECT_THAT(load(uri), HasSubstr("leaves the scene's folder")) << uri;
  EXPECT_EQ(load("stays.bin"), "");
  EXPECT_THAT(load("loop.bin"), HasSubstr("symbolic links"));
}

TEST_F(ScenePaths, WhatIsNoFileIsNotOpened) {
  ASSERT_EQ(::mkfifo((scene_ / "pipe.bin").c_str(), 0600), 0);
  EXPECT_THAT(load("pipe.bin"), HasSubstr("is not a regular file"));
  EXPECT_THAT(load("inner"), HasSubstr("is not a regular file"));
}

TEST_F(ScenePaths, PicturesAreHeldToTheSame) {
  ASSERT_TRUE(write_file(folder_.path() / "secret.png", tiny_png()));
  maker_.binary = GltfMaker::triangle().binary;
  maker_.material()["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  maker_.root["textures"] = {{{"source", 0}}};
  for (const char* const uri : {"../secret.png", "%2e%2e/secret.png"}) {
    maker_.root["images"] = {{{"uri", uri}}};
    EXPECT_THAT(load("own.bin"), AnyOf(HasSubstr("leaves the scene's folder"), HasSubstr("cannot be read"))) << uri;
  }
}

}  // namespace
}  // namespace lfd::test
