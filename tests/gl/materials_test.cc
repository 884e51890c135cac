// Surfaces: sides, alpha masks, unlit colours, vertex colours, textures, and where pixels are.
#include <gtest/gtest.h>

#include "bench/reference/texture.h"
#include "tests/gl/picture_scene.h"

namespace lfd {
namespace {

using namespace testing_support;
using reference::SceneMaker;

constexpr PixelIndex kMiddle{30, 20};
constexpr proto::BufferKind kFloatBuffers[] = {proto::POSITION, proto::NORMAL, proto::AO, proto::DEPTH};

int level_of(double linear) { return static_cast<int>(std::lround(255 * reference::srgb_from_linear(linear))); }

// GL may encode sRGB with an error of 0.6 levels.
void expect_near(const Levels& found, const Levels& expected) {
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1) << "channel " << c;
}

TEST(Materials, TheBackOfASingleSidedSurfaceIsInNoBuffer) {
  for (auto settings : both_plans()) {
    settings.mutable_background()->set_g(0.5);
    (*settings.mutable_ao()->mutable_parameter())["symmetric"] = 1;  // an open plane is open
    SceneMaker maker;
    maker.data().scene.mutable_light()->Add(light(proto::Light::AMBIENT, {1, 1, 1}));
    maker.add_mesh(turned(whole_screen()), maker.add_material({}));
    maker.add_mesh(rectangle(-1, -1, 0, 1, -0.1F),
                   maker.add_material({}));  // something to be seen at the left, behind it
    const Shot shot = shoot(maker.data(), settings);
    const PixelIndex right{50, 20}, left{10, 20};
    for (const auto kind : kFloatBuffers) {
      EXPECT_EQ(shot.value(kind, right), (std::array<float, 4>{})) << proto::BufferKind_Name(kind);
      EXPECT_EQ(shot.value(kind, left)[3], 1) << proto::BufferKind_Name(kind);
    }
    EXPECT_NEAR(shot.value(proto::DEPTH, left)[0], -0.1, 1e-6);
    expect_near(shot.color(right), {0, level_of(0.5), 0});
    EXPECT_EQ(shot.color(left), (Levels{255, 255, 255}));
  }
}

TEST(Materials, TheBackOfADoubleSidedSurfaceIsSeenWithItsNormalTowardTheViewer) {
  for (const auto& settings : both_plans()) {
    for (const bool from_behind : {false, true}) {
      SceneMaker maker;
      maker.data().scene.mutable_light()->Add(light(proto::Light::HEAD, {1, 1, 1}));
      maker.add_mesh(from_behind ? turned(whole_screen()) : whole_screen(), maker.add_material({.double_sided = true}));
      const Shot shot = shoot(maker.data(), settings);
      EXPECT_EQ(shot.value(proto::NORMAL, kMiddle), (std::array<float, 4>{0, 0, 1, 1}));
      EXPECT_TRUE(shot.has_surface(kMiddle));
      EXPECT_EQ(shot.color(kMiddle), (Levels{255, 255, 255}));
    }
  }
}

// Left half of alpha 76 / 255, right half of 204 / 255.
Picture8 two_alphas() {
  Picture8 picture{2, 1, {255, 255, 255, 76, 255, 255, 255, 204}};
  return picture;
}

TEST(Materials, FragmentsBelowTheAlphaCutoffAreInNoBuffer) {
  struct Mask {
    float factor, vertex;
    bool left, right;
  };
  for (const auto& settings : both_plans()) {
    for (const Mask& mask : {Mask{1, 1, false, true}, Mask{0.5F, 1, false, false}, Mask{1, 0.75F, false, true},
                             Mask{1, 0.5F, false, false}}) {
      SceneMaker maker;
      const auto material = maker.add_material({.alpha_cutoff = 0.5F, .base_color = {1, 1, 1, mask.factor}});
      proto::Texture& texture = *maker.data().scene.mutable_material(static_cast<int>(material))->mutable_texture();
      texture.set_picture(add_picture(maker.data(), two_alphas()));
      texture.set_nearest(true);
      MeshArrays mesh = rectangle(-0.32F, -0.24F, 0.32F, 0.24F);
      mesh.color.assign(4, {1, 1, 1, mask.vertex});
      maker.add_mesh(mesh, material);
      const Shot shot = shoot(maker.data(), settings);
      const PixelIndex left{10, 20}, right{50, 20};
      for (const auto kind : kFloatBuffers) {
        EXPECT_EQ(shot.value(kind, left)[3], mask.left ? 1 : 0) << proto::BufferKind_Name(kind);
        EXPECT_EQ(shot.value(kind, right)[3], mask.right ? 1 : 0) << proto::BufferKind_Name(kind);
      }
    }
  }
}

TEST(Materials, AlphaEqualToTheCutoffIsDrawnAndWithoutACutoffAlphaIsIgnored) {
  for (const auto& cutoff : {std::optional<float>(0.5F), std::optional<float>()}) {
    SceneMaker maker;
    maker.add_mesh(whole_screen(),
                   maker.add_material({.alpha_cutoff = cutoff, .base_color = {1, 1, 1, cutoff.value_or(0)}}));
    EXPECT_TRUE(shoot(maker.data()).has_surface(kMiddle));
  }
}

// All 256 levels in 16 x 16 texels, one a pixel.
TEST(Materials, UnlitColoursReachTheImageUnchanged) {
  Picture8 picture{16, 16, {}};
  for (int i = 0; i < 256; ++i) {
    for (const int part : {i, 255 - i, i * 7 % 256, 255}) picture.rgba.push_back(static_cast<std::uint8_t>(part));
  }
  for (const auto& settings : both_plans()) {
    for (const bool by_setting : {false, true}) {
      SceneMaker maker;
      const auto material = maker.add_material({});
      proto::Material& message = *maker.data().scene.mutable_material(static_cast<int>(material));
      message.mutable_texture()->set_picture(add_picture(maker.data(), picture));
      message.mutable_texture()->set_nearest(true);
      message.set_unlit(!by_setting);
      maker.add_mesh(rectangle(-0.08F, -0.08F, 0.08F, 0.08F), material);
      maker.add_mesh(rectangle(-0.3F, -0.08F, -0.2F, 0.08F),
                     maker.add_material({}));  // lit, so that there are lights and occlusion
      maker.data().scene.mutable_light()->Add(light(proto::Light::AMBIENT, {0.1F, 0.2F, 0.3F}));
      proto::RenderSettings all = settings;
      all.set_unlit(by_setting);
      const Shot shot = shoot(maker.data(), all);
      for (int i = 0; i < 256; ++i) {
        const auto& texel = picture.rgba;
        const std::size_t at = 4 * static_cast<std::size_t>(i);
        ASSERT_EQ(shot.color({24 + i % 16, 16 + i / 16}), (Levels{texel[at], texel[at + 1], texel[at + 2]}))
            << "level " << i;
      }
    }
  }
}

TEST(Materials, ColourIsFactorTimesVertexColourInLinearLight) {
  SceneMaker maker;
  const auto material = maker.add_material({.base_color = {0.5F, 0.25F, 1, 1}});
  maker.data().scene.mutable_material(0)->set_unlit(true);
  MeshArrays mesh = rectangle(-0.32F, -0.24F, 0.32F, 0.24F);
  for (const float x : {0.F, 1.F, 1.F, 0.F}) mesh.color.push_back({x, 0.5F, 1 - x, 1});
  maker.add_mesh(mesh, material);
  const Shot shot = shoot(maker.data());
  for (const int column : {0, 10, 31, 32, 50, 63}) {
    const double x = (column + 0.5) / 64;
    const Levels found = shot.color({column, 20}), expected{level_of(0.5 * x), level_of(0.125), level_of(1 - x)};
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(found[c], expected[c], 1) << "column " << column << ", channel " << c;
  }
}

struct Sampling {
  proto::Texture::Wrap wrap_s, wrap_t;
  bool nearest, transformed;
};

std::vector<Sampling> all_samplings() {
  const auto wraps = {proto::Texture::REPEAT, proto::Texture::CLAMP_TO_EDGE, proto::Texture::MIRRORED_REPEAT};
  std::vector<Sampling> all;
  for (const auto s : wraps) {
    for (const auto t : wraps) {
      for (const bool nearest : {false, true}) all.push_back({s, t, nearest, (all.size() / 2) % 2 == 1});
    }
  }
  return all;
}

// Magnified pictures against the reference's filter in double precision, over two periods each way.
TEST(Materials, TexturesWrapTransformAndFilterAsTheReferenceDoes) {
  Picture8 picture{4, 3, {}};
  for (int i = 0; i < 12; ++i) {
    for (const int part : {100 + 50 * (i % 4), 80 + 60 * (i / 4), 250 - 12 * i, 255})
      picture.rgba.push_back(static_cast<std::uint8_t>(part));
  }
  for (const Sampling& sampling : all_samplings()) {
    SceneMaker maker;
    maker.add_material({});
    proto::Material& material = *maker.data().scene.mutable_material(0);
    material.set_unlit(true);
    proto::Texture& texture = *material.mutable_texture();
    texture.set_picture(add_picture(maker.data(), picture));
    texture.set_wrap_s(sampling.wrap_s);
    texture.set_wrap_t(sampling.wrap_t);
    texture.set_nearest(sampling.nearest);
    if (sampling.transformed) {
      for (const float entry : {0.4F, 0.2F, 0.15F, -0.25F, 0.35F, 0.6F}) texture.add_uv_transform(entry);
    }
    MeshArrays mesh = rectangle(-0.32F, -0.24F, 0.32F, 0.24F);
    for (auto& uv : mesh.uv) uv = 2.F * uv - 0.7F;
    maker.add_mesh(mesh, 0);
    const Shot shot = shoot(maker.data());
    const auto expected = reference::Texture::make(texture, picture);
    ASSERT_TRUE(expected);
    for (int row = 0; row < 48; ++row) {
      for (int column = 0; column < 64; ++column) {
        const glm::dvec2 uv(2 * (column + 0.5) / 64 - 0.7, 2 * (row + 0.5) / 48 - 0.7);
        // Nearest texels are not compared where float32 may fall on the other side of a border.
        const glm::dvec2 aside(1e-4, 1e-4);
        if (sampling.nearest &&
            (expected->sample(uv + aside) != expected->sample(uv - aside) ||
             expected->sample(uv + aside * glm::dvec2(1, -1)) != expected->sample(uv - aside * glm::dvec2(1, -1)))) {
          continue;
        }
        const Levels found = shot.color({column, row});
        const auto linear = expected->sample(uv);
        for (int c = 0; c < 3; ++c) {
          // Filters may know a texel's fraction to 1/256 only: of a step of at most 200 levels that is one level, and
          // one for rounding.
          ASSERT_NEAR(found[static_cast<std::size_t>(c)], level_of(linear[c]), sampling.nearest ? 0 : 2)
              << column << " " << row << ": wraps " << sampling.wrap_s << " " << sampling.wrap_t << ", nearest "
              << sampling.nearest << ", transformed " << sampling.transformed;
        }
      }
    }
  }
}

TEST(Materials, ATriangleAtOnePixelsCentreIsInThatPixelAlone) {
  for (const PixelIndex pixel : {PixelIndex{5, 3}, PixelIndex{0, 0}, PixelIndex{63, 47}}) {
    const auto centre = centre_in_world(pixel);
    const auto x = static_cast<float>(centre.x), y = static_cast<float>(centre.y);
    SceneMaker maker;
    maker.add_triangles({{glm::vec3(x - 0.003F, y - 0.002F, 0), {x + 0.003F, y - 0.002F, 0}, {x, y + 0.003F, 0}}},
                        maker.add_material({}));
    const Shot shot = shoot(maker.data());
    for (int row = 0; row < 48; ++row) {
      for (int column = 0; column < 64; ++column) {
        ASSERT_EQ(shot.has_surface({column, row}), (PixelIndex{column, row} == pixel)) << column << " " << row;
      }
    }
    const auto p = shot.value(proto::POSITION, pixel);
    EXPECT_NEAR(p[0], centre.x, 1e-6) << "float rounding of metres below one";
    EXPECT_NEAR(p[1], centre.y, 1e-6);
    EXPECT_NEAR(p[2], 0, 1e-6);
  }
}

TEST(Materials, WhereNothingIsThereIsTheBackground) {
  for (auto settings : both_plans()) {
    settings.mutable_background()->set_r(0.2);
    settings.mutable_background()->set_g(0.5);
    settings.mutable_background()->set_b(0.8);
    for (const bool unlit : {false, true}) {
      settings.set_unlit(unlit);
      SceneMaker maker;
      maker.add_mesh(rectangle(-0.1F, -0.1F, 0.1F, 0.1F), maker.add_material({}));
      const Shot shot = shoot(maker.data(), settings);
      expect_near(shot.color({2, 2}), {level_of(0.2), level_of(0.5), level_of(0.8)});
      EXPECT_NE(shot.color(kMiddle), shot.color({2, 2}));
    }
  }
}

TEST(Materials, AModuleThatSeesNothingSendsEmptyImages) {
  SceneMaker maker;
  maker.add_mesh(rectangle(5, 5, 6, 6), maker.add_material({}));
  const Shot shot = shoot(maker.data());
  for (const auto kind : {proto::COLOR, proto::POSITION, proto::NORMAL, proto::AO, proto::DEPTH}) {
    EXPECT_TRUE(shot.image(kind).empty) << proto::BufferKind_Name(kind);
    EXPECT_EQ(shot.image(kind).bytes, nullptr);
  }
  EXPECT_TRUE(shoot(SceneData()).image(proto::COLOR).empty) << "a scene of nothing at all";
}

}  // namespace
}  // namespace lfd
