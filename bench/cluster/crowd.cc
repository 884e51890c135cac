// Nodes in rows and columns.
#include "bench/cluster/crowd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "base/file.h"
#include "base/log.h"

namespace lfd::bench {
namespace {

constexpr double kAspect = 16.0 / 9;  // columns to rows

// The only buffer: corners, then the keys' times, then the keys' places.
struct Buffer {
  std::array<float, 9> corner{0, 0, 0, 0.8F, 0, 0, 0, 0.8F, 0};
  std::array<float, 3> time_s{0, 1, 2};
  std::array<float, 9> place{0, 0, 0.5F, 0.5F, 0.3F, 1, 0, 0, 0.5F};
};
static_assert(sizeof(Buffer) == 84);

constexpr const char* kArrays = R"(
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"animations":[{"samplers":[{"input":1,"output":2}],
  "channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}]}],
"accessors":[
  {"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[0.8,0.8,0]},
  {"bufferView":1,"componentType":5126,"count":3,"type":"SCALAR","min":[0],"max":[2]},
  {"bufferView":2,"componentType":5126,"count":3,"type":"VEC3"}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":12},
  {"buffer":0,"byteOffset":48,"byteLength":36}],
"buffers":[{"byteLength":84,"uri":"crowd.bin"}])";

}  // namespace

Result<std::filesystem::path> write_crowd(const std::filesystem::path& folder, int resting) {
  const int all = resting + kCrowdMoving;
  const int columns = std::max(1, static_cast<int>(std::ceil(std::sqrt(kAspect * all))));
  // Node 0 moves with those below it; what rests stands beside it.
  std::string nodes = R"({"children":[)", roots = "0";
  for (int i = 1; i <= kCrowdMoving; ++i) nodes += fmt::format("{}{}", i == 1 ? "" : ",", i);
  nodes += "]}";
  for (int i = 0; i < all; ++i) {
    nodes += fmt::format(",\n{{\"mesh\":0,\"translation\":[{},{},0]}}", i % columns, i / columns);
    if (i >= kCrowdMoving) roots += fmt::format(",{}", i + 1);
  }
  const std::string text = fmt::format(
      "{{\"asset\":{{\"version\":\"2.0\"}},\"scene\":0,\"scenes\":[{{\"nodes\":[{}]}}],\n\"nodes\":[{}],{}}}\n", roots,
      nodes, kArrays);
  const Buffer buffer;
  LFD_TRY_STATUS(write_file(folder / "crowd.bin", {reinterpret_cast<const char*>(&buffer), sizeof(buffer)}));
  LFD_TRY_STATUS(write_file(folder / "crowd.gltf", text));
  return folder / "crowd.gltf";
}

}  // namespace lfd::bench
