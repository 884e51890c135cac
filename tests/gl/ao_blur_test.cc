// Both blurs of ambient occlusion beside their twins in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/gl/ao_scenes.h"

namespace lfd {
namespace {

using testing_support::AoPixel;
using testing_support::AoStage;
using testing_support::ball_stage;
using testing_support::floats;
using testing_support::inner;
using testing_support::plain_ao;
using testing_support::plane;

// One direction of the Gaussian over a field of one value a pixel, -1 where there is none; in double precision.
std::vector<double> blurred(const std::vector<double>& field, ImageSize size, double sigma, int dx, int dy) {
  const int taps = std::min(24, static_cast<int>(std::ceil(2.5 * sigma)));
  const auto at = [&](int x, int y) { return field[static_cast<std::size_t>(y) * size.width + x]; };
  std::vector<double> result;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      double sum = 0, weight = 0;
      for (int i = -taps; i <= taps; ++i) {
        const int u = x + i * dx, v = y + i * dy;
        if (u < 0 || v < 0 || u >= size.width || v >= size.height || at(u, v) < 0) continue;
        const double w = std::exp(-0.5 * i * i / (sigma * sigma));
        sum += w * at(u, v);
        weight += w;
      }
      result.push_back(at(x, y) < 0 ? -1 : sum / weight);
    }
  }
  return result;
}

// Noise, outlines, holes and the image's border are all in this picture.
TEST(AoBlur, InTheGaussianHolesAndTheOutsideWeighNothing) {
  AoStage stage = ball_stage();
  auto ao = plain_ao(0.1, 8, proto::AmbientOcclusion::UNIFORM);
  std::vector<double> sharp;
  const auto drawn = floats(stage.draw_buffers(ao), proto::AO);
  for (std::size_t i = 0; i < drawn.size(); i += 4) sharp.push_back(drawn[i + 3] == 0 ? -1 : drawn[i]);
  ASSERT_GT(std::ranges::count(sharp, -1.0), 500);
  ao.mutable_blur()->set_enabled(true);
  for (const double sigma : {0.5, 1.5, 8.0}) {
    ao.mutable_blur()->set_sigma_px(sigma);
    const ImageSize size = stage.display().image;
    const auto expected = blurred(blurred(sharp, size, sigma, 1, 0), size, sigma, 0, 1);
    const auto found = floats(stage.draw_buffers(ao), proto::AO);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      if (expected[i] < 0) {
        ASSERT_EQ(found[4 * i + 3], 0);
      } else {
        // Each direction is stored as a half float, which GL may round either way: 2^-11 below 1; the rest is float
        // rounding.
        ASSERT_NEAR(found[4 * i], expected[i], 2.0 / 2048 + 1e-5) << "pixel " << i << ", sigma " << sigma;
      }
    }
  }
}

// One direction of the blur by geometry, in double precision; floats of positions and normals as they are read back.
std::vector<double> blurred_by_geometry(const std::vector<double>& field, const std::vector<float>& p,
                                        const std::vector<float>& n, ImageSize size, int taps, double radius, int dx,
                                        int dy) {
  const auto three = [](const std::vector<float>& all, std::size_t i) {
    return glm::dvec3(all[4 * i], all[4 * i + 1], all[4 * i + 2]);
  };
  std::vector<double> result;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const std::size_t here = static_cast<std::size_t>(y) * size.width + x;
      double sum = 0, weight = 0;
      for (int i = -taps; i <= taps && field[here] >= 0; ++i) {
        const int u = x + i * dx, v = y + i * dy;
        if (u < 0 || v < 0 || u >= size.width || v >= size.height) continue;
        const std::size_t there = static_cast<std::size_t>(v) * size.width + u;
        if (field[there] < 0) continue;
        const double alike = 0.5 + 0.5 * glm::dot(glm::normalize(three(n, here)), glm::normalize(three(n, there)));
        const double apart = std::abs(three(p, there).z - three(p, here).z);  // world and physical space are the same
        const double w = i == 0 ? 1 : std::pow(alike, 10) / std::sqrt(1 + 10 * apart / radius);
        sum += w * field[there];
        weight += w;
      }
      result.push_back(field[here] < 0 ? -1 : sum / weight);
    }
  }
  return result;
}

TEST(AoBlur, ByGeometryWeighsNormalsAndDepths) {
  AoStage stage = ball_stage();
  auto ao = plain_ao(0.1, 8, proto::AmbientOcclusion::UNIFORM);
  const auto share_of = [&](const FrameResult& result) {
    const auto drawn = floats(result, proto::AO);
    std::vector<double> share;
    for (std::size_t i = 0; i < drawn.size(); i += 4) share.push_back(drawn[i + 3] == 0 ? -1 : drawn[i]);
    return share;
  };
  const FrameResult plain = stage.draw_buffers(ao, {proto::NORMAL});
  const auto sharp = share_of(plain);
  const auto p = floats(plain, proto::POSITION), n = floats(plain, proto::NORMAL);
  ao.mutable_blur()->set_enabled(true);
  ao.mutable_blur()->set_kind(proto::AmbientOcclusion::Blur::GEOMETRY);
  for (const int taps : {1, 2, 3}) {
    ao.mutable_blur()->set_taps(taps);
    const ImageSize size = stage.display().image;
    const auto across = blurred_by_geometry(sharp, p, n, size, taps, 0.1, 1, 0);
    const auto expected = blurred_by_geometry(across, p, n, size, taps, 0.1, 0, 1);
    const auto found = share_of(stage.draw_buffers(ao));
    double moved = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      // As of the Gaussian; the power of ten magnifies the roundings of a weight tenfold.
      ASSERT_NEAR(found[i], expected[i], 2.0 / 2048 + 1e-4) << "pixel " << i << ", taps " << taps;
      moved = std::max(moved, std::abs(expected[i] - sharp[i]));
    }
    EXPECT_GT(moved, 0.1) << "it does blur";
  }
}

TEST(AoBlur, OfAConstantFieldIsConstant) {
  AoStage stage(plane({0, 0}), reference::same_spaces(), reference::one_module(Diffuser::kLinear, {128, 96}));
  auto ao = plain_ao(0.05, 8, proto::AmbientOcclusion::JITTERED);
  (*ao.mutable_parameter())["symmetric"] = 1;
  ao.mutable_blur()->set_enabled(true);
  const auto pixels = inner(stage, stage.draw(ao), 0.1);  // twice the radius: the blur reaches 4 pixels further
  ASSERT_GT(pixels.size(), 1000U);
  // A sum a rounding below 1/2 is the next lower half float where a GPU cuts off instead of rounding, as GL allows:
  // once in each direction.
  for (const AoPixel& pixel : pixels) ASSERT_NEAR(pixel.ao, 0.5, 0x1p-11);
}

}  // namespace
}  // namespace lfd
