// The ordinary perspective picture against closed forms, and the measure that compares pictures.
#include <gtest/gtest.h>

#include <cmath>

#include "bench/reference/perspective.h"
#include "bench/reference/psnr.h"
#include "bench/reference/scene_maker.h"
#include "proto/pictures/png.h"

namespace lfd::reference {
namespace {

constexpr ScreenSize kScreen{1.6, 0.9};

Picture8 noise(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> byte(0, 255);
  Picture8 picture = black_picture(width, height);
  for (std::size_t i = 0; i < picture.rgba.size(); ++i) picture.rgba[i] = i % 4 == 3 ? 255 : std::uint8_t(byte(random));
  return picture;
}

void set_texture(SceneMaker& maker, const Picture8& picture) {
  proto::Picture asset;
  asset.set_file(*encode_png(picture));
  maker.data().assets["picture"] = std::make_shared<const std::string>(asset.SerializeAsString());
  proto::Texture& texture = *maker.data().scene.mutable_material(0)->mutable_texture();
  texture.set_picture("picture");
  texture.set_wrap_s(proto::Texture::CLAMP_TO_EDGE);
  texture.set_wrap_t(proto::Texture::CLAMP_TO_EDGE);
}

TEST(Perspective, APictureOnTheScreenIsSeenAsItIsFromEverywhere) {
  const Picture8 picture = noise(32, 18, 1);
  SceneMaker maker;
  const std::uint32_t material = maker.add_material({.double_sided = true});
  set_texture(maker, picture);
  // Corners from the top left, as texture coordinates run.
  maker.add_quad({-0.8F, 0.45F, 0}, {0.8F, 0.45F, 0}, {0.8F, -0.45F, 0}, {-0.8F, -0.45F, 0}, material);
  const WorldScene scene = scene_of(maker);
  const Intersector intersector(scene);
  for (const Point3<Physical> eye : {Point3<Physical>{0, 0, 3}, Point3<Physical>{-0.7, 0.4, 1.5}}) {
    EXPECT_EQ(perspective(intersector, kScreen, eye, {.size = {32, 18}}).encoded, picture);
  }
}

// Red grows with x, green with y over a quad of +-1 m at depth z, linearly.
MeshArrays ramp(float z) {
  MeshArrays mesh;
  mesh.position = {{-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}};
  mesh.normal.assign(4, {0, 0, 1});
  mesh.color = {{0, 0, 0, 1}, {1, 0, 0, 1}, {1, 1, 0, 1}, {0, 1, 0, 1}};
  mesh.index = {0, 1, 2, 0, 2, 3};
  return mesh;
}

TEST(Perspective, AQuadIsWhereLinesThroughTheEyeMeetIt) {
  const Point3<Physical> eye{0.4, -0.1, 2.5};
  for (const float z : {-1.5F, 0.7F}) {  // behind the screen and before it
    SceneMaker maker;
    maker.add_mesh(ramp(z), maker.add_material({.base_color = {0.5F, 1, 1, 1}}));
    const WorldScene scene = scene_of(maker);
    const Intersector intersector(scene);
    const PerspectivePicture picture =
        perspective(intersector, kScreen, eye, {.size = {40, 30}, .background = {0, 0, 1}});
    int background = 0;
    for (int row = 0; row < 30; ++row) {
      for (int column = 0; column < 40; ++column) {
        const double sx = 1.6 * ((column + 0.5) / 40 - 0.5), sy = 0.9 * (0.5 - (row + 0.5) / 30);
        const double zoom = (eye.z - static_cast<double>(z)) / eye.z;
        const double x = eye.x + (sx - eye.x) * zoom, y = eye.y + (sy - eye.y) * zoom;
        const bool inside = std::abs(x) < 1 && std::abs(y) < 1;
        const float* found = &picture.linear.rgba[4 * (row * 40 + column)];
        // 1e-7: the pictures are float32.
        EXPECT_NEAR(found[0], inside ? 0.5 * (x + 1) / 2 : 0, 1e-7) << column << ", " << row;
        EXPECT_NEAR(found[1], inside ? (y + 1) / 2 : 0, 1e-7);
        EXPECT_EQ(found[2], inside ? 0 : 1);
        background += !inside;
      }
    }
    EXPECT_EQ(background > 0, z < 0) << "the window is wider than the far quad, narrower than the near one: "
                                     << background;
  }
}

TEST(Perspective, NearerSurfacesHideFartherOnesWithinTheLimits) {
  SceneMaker maker;
  const std::uint32_t red = maker.add_material({.base_color = {1, 0, 0, 1}}),
                      green = maker.add_material({.base_color = {0, 1, 0, 1}});
  maker.add_quad({-5, -5, 0.5F}, {5, -5, 0.5F}, {5, 5, 0.5F}, {-5, 5, 0.5F}, red);
  maker.add_quad({-5, -5, -0.5F}, {5, -5, -0.5F}, {5, 5, -0.5F}, {-5, 5, -0.5F}, green);
  const WorldScene scene = scene_of(maker);
  const Intersector intersector(scene);
  const auto color = [&](ZLimits limits) {
    const auto picture = perspective(intersector, kScreen, {0, 0, 3}, {.size = {1, 1}, .limits = limits});
    return std::vector<std::uint8_t>(picture.encoded.rgba.begin(), picture.encoded.rgba.begin() + 3);
  };
  EXPECT_EQ(color({}), (std::vector<std::uint8_t>{255, 0, 0}));
  EXPECT_EQ(color({0.4, -1}), (std::vector<std::uint8_t>{0, 255, 0}));
  EXPECT_EQ(color({0.4, -0.4}), (std::vector<std::uint8_t>{0, 0, 0}));
}

TEST(Perspective, SupersamplesAreAveragedInLinearLight) {
  // A white edge at x = 0.1 pixel right of a pixel's centre: 5 of 8 sub-pixel columns are white.
  SceneMaker maker;
  const float edge = static_cast<float>(0.1 * 1.6 / 5);
  maker.add_quad({-2, -2, 0}, {edge, -2, 0}, {edge, 2, 0}, {-2, 2, 0}, maker.add_material({}));
  const WorldScene scene = scene_of(maker);
  const Intersector intersector(scene);
  const auto picture = perspective(intersector, kScreen, {0.3, 0, 3}, {.size = {5, 3}, .samples_per_side = 8});
  const std::size_t middle = 4 * (5 * 1 + 2);
  EXPECT_NEAR(picture.linear.rgba[middle], 0.625, 1e-7);
  EXPECT_EQ(picture.encoded.rgba[middle], std::lround(255 * srgb_from_linear(0.625)));
}

TEST(SrgbTransfer, GoesThereAndBackForEveryByte) {
  for (int i = 0; i < 256; ++i) EXPECT_NEAR(srgb_from_linear(linear_from_srgb(i / 255.0)), i / 255.0, 1e-12);
  EXPECT_NEAR(linear_from_srgb(0.5), 0.21404114, 1e-8);
}

TEST(ReferenceTexture, WrapsAsGltfSays) {
  const Picture8 picture{4, 1, {0, 0, 0, 0, 0, 0, 0, 85, 0, 0, 0, 170, 0, 0, 0, 255}};  // alpha 0, 1/3, 2/3, 1
  const auto alpha = [&](proto::Texture::Wrap wrap, double u, bool nearest) {
    proto::Texture description;
    description.set_wrap_s(wrap);
    description.set_nearest(nearest);
    return Texture::make(description, picture)->sample({u, 0.5}).a;
  };
  const double third = 1.0 / 3;
  EXPECT_NEAR(alpha(proto::Texture::REPEAT, 0.125, false), 0, 1e-7);
  EXPECT_NEAR(alpha(proto::Texture::REPEAT, 0.25, false), third / 2, 1e-7) << "halfway between two texels";
  EXPECT_NEAR(alpha(proto::Texture::REPEAT, 1, false), 0.5, 1e-7) << "between the last and the first";
  EXPECT_NEAR(alpha(proto::Texture::REPEAT, -0.125, false), 1, 1e-7);
  EXPECT_NEAR(alpha(proto::Texture::CLAMP_TO_EDGE, 7, false), 1, 1e-7);
  EXPECT_NEAR(alpha(proto::Texture::CLAMP_TO_EDGE, -7, false), 0, 1e-7);
  EXPECT_NEAR(alpha(proto::Texture::MIRRORED_REPEAT, 1.125, false), 1, 1e-7);
  EXPECT_NEAR(alpha(proto::Texture::MIRRORED_REPEAT, -0.375, false), third, 1e-7);
  EXPECT_NEAR(alpha(proto::Texture::REPEAT, 0.49, true), third, 1e-7);
}

TEST(Psnr, KnownDifferences) {
  const Picture8 a{8, 6, std::vector<std::uint8_t>(8 * 6 * 4, 100)};
  Picture8 b = a;
  EXPECT_EQ(psnr_db(a, b), INFINITY);
  for (std::size_t i = 3; i < b.rgba.size(); i += 4) b.rgba[i] = 7;
  EXPECT_EQ(psnr_db(a, b), INFINITY) << "alpha does not count";
  for (std::uint8_t& byte : b.rgba) byte = 110;
  EXPECT_NEAR(psnr_db(a, b), 20 * std::log10(25.5), 1e-12);
  b = a;
  b.rgba[0] = 0;  // red of the top left pixel
  EXPECT_NEAR(psnr_db(a, b), 10 * std::log10(255.0 * 255 * 8 * 6 * 3 / 1e4), 1e-12);
  EXPECT_EQ(psnr_db(a, b, 1), INFINITY) << "it lies in the border";
}

}  // namespace
}  // namespace lfd::reference
