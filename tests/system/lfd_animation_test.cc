// A scene that moves, through all processes: every frame shows it where its keyframes say, in a region that stays.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/file.h"
#include "base/log.h"
#include "proto/frame_files.h"
#include "proto/pictures/exr.h"
#include "proto/pictures/png.h"
#include "tests/system/running_cluster.h"
#include "tests/unit/gltf_maker.h"

namespace lfd::harness {
namespace {

using test::GltfMaker;

constexpr ImageSize kImage{64, 36};
constexpr int kModules = 4;
constexpr int kFrames = 10;           // two of the second round
constexpr int kFramesPerSecond = 4;   // of the animation
constexpr double kHalfWidth_m = 0.2;  // of what moves
constexpr double kHalfHeight_m = 0.15;

// Where its centre is after 0, 1 and 2 seconds, then over again; frames differ by three pixels and more.
const std::array<glm::dvec3, 3> kKeys{glm::dvec3(-0.5, -0.1, 0), glm::dvec3(0.3, 0.1, 0.1), glm::dvec3(-0.1, 0.1, 0)};
constexpr double kBackdrop_m = -0.3;  // z of a rectangle as large as the screen, which stays

glm::dvec3 centre_in_frame(int frame) {
  const int in_round = frame % (2 * kFramesPerSecond);
  const auto key = static_cast<std::size_t>(in_round / kFramesPerSecond);
  const double t = static_cast<double>(in_round % kFramesPerSecond) / kFramesPerSecond;
  return (1 - t) * kKeys[key] + t * kKeys[key + 1];
}

// Two triangles that face +z.
int add_rectangle(GltfMaker& maker, double half_width, double half_height, double at_z) {
  const auto x = static_cast<float>(half_width), y = static_cast<float>(half_height), z = static_cast<float>(at_z);
  return maker.add_floats({-x, -y, z, x, -y, z, x, y, z, -x, -y, z, x, y, z, -x, y, z}, "VEC3");
}

// A red rectangle that moves before a white one.
std::string moving_gltf() {
  GltfMaker maker;
  maker.root["meshes"][0]["primitives"][0]["attributes"]["POSITION"] =
      add_rectangle(maker, kHalfWidth_m, kHalfHeight_m, 0);
  maker.root["meshes"][1]["primitives"][0]["attributes"]["POSITION"] = add_rectangle(maker, 0.8, 0.45, kBackdrop_m);
  maker.root["nodes"][0]["mesh"] = 0;
  maker.root["nodes"][1]["mesh"] = 1;
  maker.root["scenes"][0]["nodes"] = {0, 1};
  maker.material()["pbrMetallicRoughness"]["baseColorFactor"] = {1.0, 0.0, 0.0, 1.0};
  std::vector<float> places;
  for (const glm::dvec3& key : kKeys) {
    for (int axis = 0; axis < 3; ++axis) places.push_back(static_cast<float>(key[axis]));
  }
  maker.animate("translation", "LINEAR", {0, 1, 2}, places);
  return maker.gltf();
}

// The bounds of the positions that a picture holds of what moves.
struct Seen {
  int pixels = 0;
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
};

Seen seen_in(const PictureF& positions, const glm::dvec3& origin) {
  Seen seen;
  for (std::size_t at = 0; at + 3 < positions.rgba.size(); at += 4) {
    const float* rgba = &positions.rgba[at];
    const glm::dvec3 place = origin + glm::dvec3(rgba[0], rgba[1], rgba[2]);
    if (rgba[3] != 1 || place.z < kBackdrop_m / 2) continue;
    ++seen.pixels;
    seen.low = glm::min(seen.low, place);
    seen.high = glm::max(seen.high, place);
  }
  return seen;
}

class LfdAnimation : public testing::Test {
 protected:
  void SetUp() override {
    bench_.file("moving.gltf", moving_gltf());
    const auto deployment =
        bench_.file("moving.textproto", fmt::format("name: \"moving\" display: \"display.textproto\"\n"
                                                    "scene {{ file: \"moving.gltf\" frames_per_second: {} }}\n"
                                                    "node {{ name: \"left\" }} node {{ name: \"right\" }}",
                                                    kFramesPerSecond));
    const auto lfd = start_program("lfd", {"render", deployment, "--frames", std::to_string(kFrames), "--buffers",
                                           "position", "--no-ao", "--out", out_});
    const auto exit = lfd->wait(kClusterPatience);
    ASSERT_TRUE(exit && exit->succeeded()) << testing::PrintToString(lfd->lines());
    const auto text = read_file(out_ / "report.json");
    ASSERT_TRUE(text);
    report_ = nlohmann::json::parse(*text);
    ASSERT_EQ(report_.at("frames").size(), static_cast<std::size_t>(kFrames));
  }

  const nlohmann::json& frame(int number) const { return report_.at("frames").at(static_cast<std::size_t>(number)); }

  std::string state_of(int number) const { return frame(number).at("state_hash").get<std::string>(); }

  std::filesystem::path image(int frame_number, int module, proto::BufferKind kind) const {
    return image_path(out_, static_cast<std::uint64_t>(frame_number), static_cast<std::uint32_t>(module), kind);
  }

  Picture8 color(int frame_number, int module) const {
    const Result<Picture8> picture = read_png(image(frame_number, module, proto::COLOR));
    EXPECT_TRUE(picture) << (picture ? "" : picture.error().message());
    return picture ? *picture : Picture8();
  }

  const Workbench bench_{kImage};
  const std::filesystem::path out_ = bench_.folder() / "out";
  nlohmann::json report_;
};

TEST_F(LfdAnimation, ChangesEveryPictureAndNotTheRegionOfInterest) {
  for (int number = 1; number < kFrames; ++number) {
    EXPECT_EQ(frame(number).at("physical_from_world"), frame(0).at("physical_from_world"));
    EXPECT_NE(state_of(number), state_of(number - 1));
    for (const auto& node : frame(number).at("nodes")) EXPECT_EQ(node.at("state_hash"), state_of(number));
    for (int module = 0; module < kModules; ++module)
      EXPECT_FALSE(color(number, module) == color(number - 1, module)) << "frame " << number << ", module " << module;
  }
  for (int module = 0; module < kModules; ++module)
    EXPECT_TRUE(color(2 * kFramesPerSecond, module) == color(0, module)) << "the second round, module " << module;
}

TEST_F(LfdAnimation, PutsWhatMovesWhereItsKeyframesSay) {
  for (int number = 0; number < kFrames; ++number) {
    const std::vector<double> matrix = frame(number).at("physical_from_world").get<std::vector<double>>();
    const std::vector<double> origin = frame(number).at("position_origin").get<std::vector<double>>();
    const glm::dvec3 centre = centre_in_frame(number);
    const glm::dvec3 low = centre - glm::dvec3(kHalfWidth_m, kHalfHeight_m, 0);
    const glm::dvec3 high = centre + glm::dvec3(kHalfWidth_m, kHalfHeight_m, 0);
    // Emitters are 1 m behind the screen: at z before it a pixel is 1 + z times as wide as on it, and less high. An
    // edge lies between two pixels' lines.
    const double z_in_physical = matrix[10] * centre.z + matrix[11];
    const double pixel_in_world_m = 1.6 / kImage.width * (1 + z_in_physical) / matrix[0];
    constexpr double kDepth_m = 1e-5;  // single precision holds numbers below 1 m to 6e-8; a few roundings
    for (int module = 0; module < kModules; ++module) {
      const auto positions = read_exr(image(number, module, proto::POSITION));
      ASSERT_TRUE(positions) << positions.error().message();
      const Seen seen = seen_in(*positions, {origin[0], origin[1], origin[2]});
      SCOPED_TRACE(fmt::format("frame {}, module {}, {} pixels", number, module, seen.pixels));
      ASSERT_GT(seen.pixels, 0);
      for (int axis = 0; axis < 2; ++axis) {
        EXPECT_NEAR(seen.low[axis], low[axis], pixel_in_world_m) << "axis " << axis;
        EXPECT_NEAR(seen.high[axis], high[axis], pixel_in_world_m) << "axis " << axis;
      }
      EXPECT_NEAR(seen.low.z, centre.z, kDepth_m);
      EXPECT_NEAR(seen.high.z, centre.z, kDepth_m);
    }
  }
}

}  // namespace
}  // namespace lfd::harness
