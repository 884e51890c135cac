// Bent normals: the mean open direction that ambient occlusion finds, beside known answers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "rendernode/passes/targets.h"
#include "tests/gl/ao_bent_pixels.h"

namespace lfd {
namespace {

using testing_support::AoStage;
using testing_support::ball_stage;
using testing_support::bent_ao;
using testing_support::BentPixel;
using testing_support::draw_bent;
using testing_support::floats;
using testing_support::from_above;
using testing_support::made;
using testing_support::plane;
using testing_support::three;

constexpr double kRadius = 0.12, kFloorY = -0.45, kWallZ = -0.45;

std::vector<const occlusion::Method*> with_directions() {
  std::vector<const occlusion::Method*> methods;
  std::ranges::copy_if(occlusion::methods(), std::back_inserter(methods), &occlusion::Method::directions);
  return methods;
}

// As drawn with half the resolution, and with each blur.
std::vector<proto::AmbientOcclusion> ways_of(const proto::AmbientOcclusion& ao) {
  std::vector<proto::AmbientOcclusion> ways(4, ao);
  ways[1].set_half_resolution(true);
  ways[2].mutable_blur()->set_enabled(true);
  ways[3].mutable_blur()->set_enabled(true);
  ways[3].mutable_blur()->set_kind(proto::AmbientOcclusion::Blur::GEOMETRY);
  return ways;
}

class BentNormals : public testing::TestWithParam<const occlusion::Method*> {};
INSTANTIATE_TEST_SUITE_P(All, BentNormals, testing::ValuesIn(with_directions()),
                         [](const auto& method) { return std::string(method.param->name); });

// However few samples, and however they lie. Normals are half floats; so are bent normals. On a slanted plane a few
// samples within rounding of it fall to the wrong side (ambient_occlusion_test.cc).
TEST_P(BentNormals, OfAnOpenPlaneAreItsNormal) {
  for (const glm::vec2 slope : {glm::vec2(0, 0), glm::vec2(0.3, -0.2)}) {
    AoStage stage(plane(slope), reference::same_spaces(), reference::one_module(Diffuser::kLinear, {96, 72}));
    const glm::dvec3 normal = glm::normalize(glm::dvec3(-slope.x, -slope.y, 1));
    auto ao = bent_ao(*GetParam(), kRadius);
    ao.set_radius_m(0.08);
    for (auto way : ways_of(ao)) {
      for (const int radii : {1, 3}) {
        way.set_radii(radii);
        std::size_t off = 0, inner = 0;
        for (const BentPixel& pixel : draw_bent(stage, way)) {
          if (pixel.at.column < 20 || pixel.at.column >= 76 || pixel.at.row < 20 || pixel.at.row >= 52) continue;
          ++inner;
          off += glm::distance(pixel.bent, normal) > 5e-3 ? 1 : 0;
        }
        ASSERT_GT(inner, 1500U);
        EXPECT_LE(off, slope.x == 0 ? 0 : static_cast<std::size_t>(radii) * inner / 50)
            << "slope " << slope.x << ", " << radii << " radii";
      }
    }
  }
}

// How far bent normals lean away from a wall: their mean over the floor at some distance from it.
glm::dvec3 mean_at(const std::vector<BentPixel>& pixels, double share_of_radius) {
  glm::dvec3 sum(0);
  int count = 0;
  for (const BentPixel& pixel : pixels) {
    if (std::abs(pixel.p.y - kFloorY) > 1e-4 || std::abs(pixel.p.x + 0.4) > 0.25) continue;
    if (std::abs((pixel.p.z - kWallZ) / kRadius - share_of_radius) > 0.1) continue;
    sum += pixel.bent;
    ++count;
  }
  EXPECT_GT(count, 30);
  return sum / static_cast<double>(count);
}

AoStage wall_stage(ImageSize image) {
  return {made("wall"), from_above(), reference::one_module(Diffuser::kLinear, image)};
}

TEST_P(BentNormals, LeanAwayFromAWallTheNearerTheMore) {
  AoStage stage = wall_stage({160, 120});
  for (const auto& way : ways_of(bent_ao(*GetParam(), kRadius))) {
    const auto pixels = draw_bent(stage, way);
    const glm::dvec3 near = mean_at(pixels, 0.3), middle = mean_at(pixels, 0.6), far = mean_at(pixels, 1.6);
    EXPECT_GT(near.z, middle.z + 0.03);
    EXPECT_GT(middle.z, 0.01);
    EXPECT_LT(near.y, 0.97);
    // Neither blur nor half the resolution leans the other way along the wall; noise of few samples.
    EXPECT_NEAR(near.x, 0, 0.05);
    EXPECT_LT(glm::distance(far, {0, 1, 0}), 0.01) << "beyond the radius the wall is nothing";
  }
}

// Means over a few hundred pixels; blurs move them by the curvature of what they blur, and by the border of the patch.
TEST_P(BentNormals, AreCarriedByBlursAndHalfTheResolution) {
  AoStage stage = wall_stage({160, 120});
  auto ao = bent_ao(*GetParam(), kRadius);
  ao.set_samples(32);
  const auto ways = ways_of(ao);
  const auto plain = draw_bent(stage, ways[0]);
  for (std::size_t i = 1; i < ways.size(); ++i) {
    const auto pixels = draw_bent(stage, ways[i]);
    for (const double share : {0.4, 0.7})
      EXPECT_LT(glm::distance(mean_at(pixels, share), mean_at(plain, share)), 0.035) << "way " << i << ", " << share;
  }
}

TEST_P(BentNormals, TurnWithTheWorld) {
  const glm::dquat turn = glm::normalize(glm::dquat(0.4, -0.5, 0.6, 0.3));
  SceneData data = testing_support::ball_before_floor();
  const auto display = reference::one_module(Diffuser::kLinear, {96, 72});
  AoStage plain(data, {}, display);
  RegionOfInterest roi;
  roi.world_orientation = turn;
  for (auto& instance : *data.scene.mutable_instance()) {
    auto& placement = *instance.mutable_world_from_mesh();
    const glm::dmat3 matrix = glm::mat3_cast(turn);
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column)
        placement[4 * row + column] = matrix[column][row];  // they were not moved
    }
  }
  AoStage turned(data, roi, display);
  const auto before = draw_bent(plain, bent_ao(*GetParam(), kRadius)),
             after = draw_bent(turned, bent_ao(*GetParam(), kRadius));
  ASSERT_EQ(before.size(), after.size());
  std::size_t off = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
    off += glm::distance(turn * before[i].bent, after[i].bent) > 0.01 ? 1 : 0;
  EXPECT_LT(off, before.size() / 50) << "samples within rounding of a surface";
}

// The radius that hides most says where it is open.
TEST_P(BentNormals, AreThoseOfTheRadiusThatHidesMost) {
  AoStage stage = ball_stage();
  const auto drawn = [&](double radius_m, int radii) {
    auto ao = bent_ao(*GetParam(), radius_m);
    ao.set_radii(radii);
    ao.mutable_curve()->set_b(1);
    ao.mutable_curve()->set_c(1);
    const FrameResult result = stage.draw_buffers(ao, {proto::BENT_NORMAL});
    return std::pair(floats(result, proto::AO), floats(result, proto::BENT_NORMAL));
  };
  const auto whole = drawn(kRadius, 1), half = drawn(kRadius / 2, 1), both = drawn(kRadius, 2);
  std::size_t larger = 0, smaller = 0;
  for (std::size_t i = 0; i < whole.first.size(); i += 4) {
    if (whole.first[i] == half.first[i]) continue;  // as half floats
    const bool is_whole = whole.first[i] > half.first[i];
    ++(is_whole ? larger : smaller);
    ASSERT_EQ(three(both.second, i), three((is_whole ? whole : half).second, i)) << "pixel " << i / 4;
  }
  EXPECT_GT(larger, 100U);
  // Of pyramid_hbao whatever hides hides less for a smaller radius.
  EXPECT_EQ(smaller > 10, GetParam()->name != "pyramid_hbao") << smaller;
}

// Every light but the ambient one sees the bent normal; nothing else of the picture changes.
TEST_P(BentNormals, AreWhatTheSunShinesOn) {
  AoStage stage = ball_stage();
  auto ao = bent_ao(*GetParam(), kRadius);
  const FrameResult with = stage.draw_buffers(ao, {proto::NORMAL, proto::BENT_NORMAL});
  const auto share = floats(with, proto::AO), bent = floats(with, proto::BENT_NORMAL),
             normal = floats(with, proto::NORMAL);
  const auto& color = *testing_support::find_image(with, 0, proto::COLOR)->bytes;
  ao.set_bent_normals(false);
  const FrameResult without = stage.draw_buffers(ao, {proto::NORMAL});
  EXPECT_EQ(share, floats(without, proto::AO)) << "what is hidden stays as it is";
  EXPECT_EQ(normal, floats(without, proto::NORMAL));
  const auto& plain = *testing_support::find_image(without, 0, proto::COLOR)->bytes;
  constexpr double ambient[] = {0.5, 0.4, 0.3}, sun[] = {0.2, 0.3, 0.4};  // down z, on white
  std::size_t changed = 0;
  for (std::size_t i = 0; i < color.size(); i += 4) {
    if (share[i + 3] == 0) {
      ASSERT_EQ(color.substr(i, 4), plain.substr(i, 4)) << "the background";
      continue;
    }
    changed += color.substr(i, 4) != plain.substr(i, 4) ? 1 : 0;
    const glm::dvec3 b = three(bent, i);
    const double cosine = glm::length(b) > 0 ? std::max(0.0, glm::normalize(b).z) : normal[i + 2];
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const double expected = ambient[channel] * (1 - share[i]) + sun[channel] * cosine;
      const double found = reference::linear_from_srgb(static_cast<std::uint8_t>(color[i + channel]) / 255.0);
      ASSERT_NEAR(found, expected, 2.3 / 255) << "a level is at most that much of linear light, pixel " << i / 4;
    }
  }
  EXPECT_GT(changed, 100U);
  ao.set_bent_normals(true);
  const FrameResult again = stage.draw_buffers(ao, {proto::NORMAL, proto::BENT_NORMAL});
  EXPECT_EQ(floats(again, proto::BENT_NORMAL), bent) << "switched off and on again";
}

// Ambient light comes from all sides: without another light the picture is the same, and nobody looks for directions.
TEST_P(BentNormals, DoNotChangeAmbientLight) {
  SceneData data = testing_support::ball_before_floor();
  data.scene.mutable_light()->RemoveLast();
  AoStage stage(data, {}, reference::one_module(Diffuser::kLinear, {96, 72}));
  auto ao = bent_ao(*GetParam(), kRadius);
  const FrameResult with = stage.draw_buffers(ao);
  ao.set_bent_normals(false);
  const FrameResult without = stage.draw_buffers(ao);
  EXPECT_EQ(*testing_support::find_image(with, 0, proto::COLOR)->bytes,
            *testing_support::find_image(without, 0, proto::COLOR)->bytes);
}

TEST_P(BentNormals, AreNumbersAtEveryRadiusOnImagesOfAnyShape) {
  for (const ImageSize image : {ImageSize{48, 36}, {1, 1}, {2, 3}}) {
    AoStage stage(testing_support::ball_before_floor(), {}, reference::one_module(Diffuser::kLinear, image));
    for (const double radius_m : {1e-6, 0.1, 200.0}) {
      auto ao = bent_ao(*GetParam(), kRadius);
      ao.set_radius_m(radius_m);
      for (const auto& way : ways_of(ao)) {
        const auto pixels = draw_bent(stage, way);
        const auto wrong =
            std::ranges::find_if(pixels, [](const BentPixel& pixel) { return !(glm::length(pixel.bent) <= 2); });
        EXPECT_TRUE(wrong == pixels.end()) << "radius " << radius_m << " on " << image.width << " x " << image.height;
      }
    }
  }
}

TEST(AoBentNormals, WithoutThePassAreNormals) {
  AoStage stage = ball_stage();
  proto::AmbientOcclusion ao;
  for (const bool on : {true, false}) {
    ao.set_enabled(on);
    const FrameResult result = stage.draw_buffers(ao, {proto::NORMAL, proto::BENT_NORMAL});
    EXPECT_EQ(floats(result, proto::BENT_NORMAL), floats(result, proto::NORMAL));
  }
}

TEST(AoBentNormals, TargetsHoldDirectionsOnlyWhereTheyAreFound) {
  testing_support::context();
  Targets targets({8, 8}, 1);
  FramePlan plan;
  plan.upsample = true;
  for (const bool bent : {false, true, true, false}) {
    plan.bent = bent;
    ASSERT_TRUE(targets.prepare(plan));
    for (const GLuint texture : {targets.ao(0), targets.ao(1), targets.half_ao()}) {
      GLint format = 0;
      glGetTextureLevelParameteriv(texture, 0, GL_TEXTURE_INTERNAL_FORMAT, &format);
      EXPECT_EQ(format, bent ? GL_RGBA16F : GL_R16F);
    }
    for (const GLuint framebuffer :
         {targets.ao_framebuffer(0), targets.ao_framebuffer(1), targets.half_ao_framebuffer()})
      EXPECT_EQ(glCheckNamedFramebufferStatus(framebuffer, GL_DRAW_FRAMEBUFFER), GL_FRAMEBUFFER_COMPLETE);
  }
}

// Where two open planes meet, neither blur nor half the resolution bends what was straight.
TEST(AoBentNormals, StayStraightAlongAnOpenEdge) {
  reference::SceneMaker maker;
  const auto plain = maker.add_material({});
  maker.add_quad({-1.2F, -1, -0.5F}, {0, -1, 0}, {0, 1, 0}, {-1.2F, 1, -0.5F}, plain);
  maker.add_quad({0, -1, 0}, {1.2F, -1, -0.5F}, {1.2F, 1, -0.5F}, {0, 1, 0}, plain);
  AoStage stage(maker.data(), {}, reference::one_module(Diffuser::kLinear, {96, 72}));
  for (const auto& way : ways_of(bent_ao(*occlusion::find_method("gtao"), kRadius))) {
    for (const BentPixel& pixel : draw_bent(stage, way)) {
      if (pixel.at.column < 20 || pixel.at.column >= 76 || pixel.at.row < 20 || pixel.at.row >= 52) continue;
      ASSERT_LT(glm::distance(pixel.bent, pixel.normal), 0.01) << pixel.at.column << ", " << pixel.at.row;
    }
  }
}

}  // namespace
}  // namespace lfd
