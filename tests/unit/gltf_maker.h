// Small glTF files for tests, put together number by number.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/file.h"
#include "controller/scene/loaded_scene.h"
#include "proto/mesh_arrays.h"
#include "proto/pictures/png.h"

namespace lfd::test {

using nlohmann::json;

inline constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123, kUnsignedInt = 5125,
                     kFloat = 5126;

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  return std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

inline std::string base64(const std::string& bytes) {
  static const char* const kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (i + k < bytes.size() ? std::uint8_t(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

// A PNG file of one black pixel.
inline std::string tiny_png() { return *encode_png(black_picture(1, 1)); }

// `root` is the file's JSON, to be changed at will; `binary` its only buffer.
struct GltfMaker {
  json root = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", {0}}}}}};
  std::string binary;

  int add_view(const std::string& bytes, int stride = 0) {
    binary.resize((binary.size() + 3) / 4 * 4);
    json view = {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
    if (stride > 0) view["byteStride"] = stride;
    binary += bytes;
    root["bufferViews"].push_back(view);
    return static_cast<int>(root["bufferViews"].size()) - 1;
  }

  int add_accessor_of(int view, int component_type, const std::string& type, std::size_t count, int offset = 0) {
    json accessor = {{"componentType", component_type}, {"type", type}, {"count", count}};
    if (view >= 0) accessor["bufferView"] = view;
    if (offset > 0) accessor["byteOffset"] = offset;
    root["accessors"].push_back(accessor);
    return static_cast<int>(root["accessors"].size()) - 1;
  }

  template <class T>
  int add_accessor(const std::vector<T>& values, int component_type, const std::string& type, std::size_t count) {
    return add_accessor_of(add_view(bytes_of(values)), component_type, type, count);
  }

  int add_floats(const std::vector<float>& values, const std::string& type) {
    const std::size_t components = type == "SCALAR" ? 1 : static_cast<std::size_t>(type.back() - '0');
    return add_accessor(values, kFloat, type, values.size() / components);
  }

  // The triangle (0,0,0) (1,0,0) (0,1,0), not indexed, without normals, on node 0.
  static GltfMaker triangle() {
    GltfMaker maker;
    maker.root["nodes"] = {{{"mesh", 0}, {"name", "stand"}}};
    const int position = maker.add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
    maker.root["meshes"] = {{{"name", "curtain"}, {"primitives", {{{"attributes", {{"POSITION", position}}}}}}}};
    return maker;
  }

  // Gives the file an animation of one property of node 0: "translation", "rotation" or "scale".
  void animate(const std::string& path, const std::string& interpolation, const std::vector<float>& times,
               const std::vector<float>& values) {
    const int input = add_floats(times, "SCALAR");
    const int output = add_floats(values, path == "rotation" ? "VEC4" : "VEC3");
    root["animations"] = {{{"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}},
                           {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}}};
  }

  json& primitive() { return root["meshes"][0]["primitives"][0]; }

  // Its material, made on first use.
  json& material() {
    if (!root.contains("materials")) root["materials"] = {json::object()};
    primitive()["material"] = 0;
    return root["materials"][0];
  }

  std::string gltf() const {
    json whole = root;
    if (!whole.contains("buffers")) {
      whole["buffers"] = {
          {{"byteLength", binary.size()}, {"uri", "data:application/octet-stream;base64," + base64(binary)}}};
    }
    return whole.dump();
  }

  std::string glb() const {
    json whole = root;
    whole["buffers"] = {{{"byteLength", binary.size()}}};
    std::string text = whole.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string chunk = binary;
    chunk.resize((chunk.size() + 3) / 4 * 4, '\0');
    const auto word = [](std::size_t value) {
      const auto small = static_cast<std::uint32_t>(value);
      return std::string(reinterpret_cast<const char*>(&small), 4);
    };
    return "glTF" + word(2) + word(28 + text.size() + chunk.size()) + word(text.size()) + "JSON" + text +
           word(chunk.size()) + std::string("BIN\0", 4) + chunk;
  }
};

// A folder of its own for the running test, removed at its end.
class Folder {
 public:
  Folder() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::path(::testing::TempDir()) /
            (std::string("lfd-") + test->test_suite_name() + "." + test->name() + std::to_string(::getpid()));
    std::filesystem::create_directories(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  const std::filesystem::path& path() const { return path_; }

  std::filesystem::path write(const std::string& name, const std::string& content) const {
    EXPECT_TRUE(write_file(path_ / name, content));
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

inline Result<LoadedScene> load_bytes(const std::string& content, const std::string& name = "test.gltf") {
  const Folder folder;
  return load_scene(folder.write(name, content));
}

inline LoadedScene loaded(const GltfMaker& maker) {
  Result<LoadedScene> scene = load_bytes(maker.gltf());
  if (!scene) throw std::runtime_error(scene.error().message());  // GoogleTest reports it as a failure of the test
  return *std::move(scene);
}

inline std::string error_of(const GltfMaker& maker) {
  const Result<LoadedScene> scene = load_bytes(maker.gltf());
  return scene ? "no error" : scene.error().message();
}

// The mesh of an instance.
inline MeshArrays mesh_of(const LoadedScene& scene, int instance = 0) {
  return mesh_arrays(*scene.data.assets.at(scene.data.scene.instance(instance).mesh())).value();
}

}  // namespace lfd::test
