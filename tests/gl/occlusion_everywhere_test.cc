// What holds for every method of ambient occlusion: pictures do not know the world's size or turn, and every radius,
// border and hole leaves numbers between open and hidden.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/gl/ao_scenes.h"

namespace lfd {
namespace {

using testing_support::ball_before_floor;
using testing_support::buffers;
using testing_support::context;
using testing_support::draw_once;
using testing_support::floats;
using testing_support::state_of;

class OcclusionEverywhere : public testing::TestWithParam<const occlusion::Method*> {
 protected:
  static proto::RenderSettings settings(double radius_m) {
    proto::RenderSettings settings;
    settings.mutable_ao()->set_method(std::string(GetParam()->name));
    settings.mutable_ao()->set_radius_m(radius_m);
    settings.mutable_ao()->mutable_blur()->set_enabled(false);
    return settings;
  }

  // Ambient occlusion of every pixel, -1 where there is no surface.
  static std::vector<float> drawn(const SceneData& data, const RegionOfInterest& roi, double radius_m,
                                  const DisplayCalibration& display) {
    Renderer renderer(context(), display, {0});
    const FrameOptions options{.buffers = buffers({proto::AO}), .reuse = false};
    const auto image =
        floats(draw_once(renderer, state_of(data, roi, settings(radius_m)), data.assets, options), proto::AO);
    std::vector<float> values;
    for (std::size_t i = 0; i < image.size(); i += 4) values.push_back(image[i + 3] == 0 ? -1 : image[i]);
    return values;
  }

  static DisplayCalibration display() { return reference::one_module(Diffuser::kLinear, {96, 72}); }
};
INSTANTIATE_TEST_SUITE_P(All, OcclusionEverywhere,
                         testing::ValuesIn(occlusion::methods().begin(), occlusion::methods().end()),
                         [](const auto& method) { return std::string(method.param->name); });

// The world moved: every instance, and the box of the region of interest with it.
SceneData moved(SceneData data, const glm::dmat3& linear) {
  for (auto& instance : *data.scene.mutable_instance()) {
    auto& placement = *instance.mutable_world_from_mesh();
    glm::dmat4 before(1);
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) before[column][row] = placement[4 * row + column];
    }
    const glm::dmat4 after = glm::dmat4(linear) * before;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) placement[4 * row + column] = after[column][row];
    }
  }
  return data;
}

// Roundings of the world's numbers turn a few samples that lie within them of a surface.
void expect_alike(const std::vector<float>& one, const std::vector<float>& other) {
  ASSERT_EQ(one.size(), other.size());
  double sum = 0;
  std::size_t differ = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    ASSERT_EQ(one[i] < 0, other[i] < 0) << "pixel " << i;
    sum += std::abs(one[i] - other[i]) / static_cast<double>(one.size());
    differ += std::abs(one[i] - other[i]) > 1e-3 ? 1 : 0;
  }
  EXPECT_LT(sum, 1e-3);
  EXPECT_LT(differ, one.size() / 100);
}

TEST_P(OcclusionEverywhere, TheWorldsSizeDoesNotMatter) {
  const SceneData data = ball_before_floor();
  RegionOfInterest large;
  large.world_size *= 1e3;
  expect_alike(drawn(data, {}, 0.1, display()), drawn(moved(data, glm::dmat3(1e3)), large, 100, display()));
}

TEST_P(OcclusionEverywhere, TheWorldsTurnDoesNotMatter) {
  const SceneData data = ball_before_floor();
  RegionOfInterest turned;
  turned.world_orientation = glm::normalize(glm::dquat(0.4, -0.5, 0.6, 0.3));
  expect_alike(drawn(data, {}, 0.1, display()),
               drawn(moved(data, glm::mat3_cast(turned.world_orientation)), turned, 0.1, display()));
}

// From the least radius there is to one of a hundred regions, on images of any shape, with holes and borders in view.
TEST_P(OcclusionEverywhere, EveryRadiusAndImageLeavesNumbersBetweenOpenAndHidden) {
  const SceneData data = ball_before_floor();
  const double diagonal_m = RegionOfInterest{}.diagonal_m();
  for (const ImageSize image : {ImageSize{96, 72}, {1, 1}, {1, 64}, {2, 3}}) {
    DisplayCalibration shown = display();
    shown.image = image;
    for (const double radius_m : {2e-7 * diagonal_m, 1e-3, 0.1, 1.0, 100 * diagonal_m}) {
      const auto values = drawn(data, {}, radius_m, shown);
      const auto wrong = std::ranges::find_if(values, [](float v) { return v != -1 && !(v >= 0 && v <= 1); });
      EXPECT_EQ(wrong, values.end()) << *wrong << " at pixel " << wrong - values.begin() << " of " << image.width
                                     << " x " << image.height << ", radius " << radius_m;
    }
  }
}

// Where half of the pixels are shaded, the others come close: their surfaces are mostly their neighbours' own.
TEST_P(OcclusionEverywhere, HalfTheResolutionShowsTheSame) {
  const SceneData data = ball_before_floor();
  DisplayCalibration shown = display();
  shown.image = {193, 145};  // odd: the last column and row have samples of their own
  Renderer renderer(context(), shown, {0});
  const auto draw = [&](bool half) {
    proto::RenderSettings wanted = settings(0.1);
    wanted.mutable_ao()->set_half_resolution(half);
    wanted.mutable_ao()->set_samples(64);
    wanted.mutable_ao()->mutable_blur()->set_enabled(true);
    const FrameOptions options{.buffers = buffers({proto::AO}), .reuse = false};
    return floats(draw_once(renderer, state_of(data, {}, wanted), data.assets, options), proto::AO);
  };
  const auto full = draw(false), half = draw(true);
  double off = 0, sum = 0;
  std::size_t pixels = 0;
  for (std::size_t i = 0; i < full.size(); i += 4) {
    ASSERT_EQ(full[i + 3], half[i + 3]) << "pixel " << i / 4;
    if (full[i + 3] == 0) continue;
    off += std::abs(full[i] - half[i]);
    sum += full[i];
    ++pixels;
  }
  ASSERT_GT(pixels, 5000U);
  EXPECT_LT(off / static_cast<double>(pixels), 0.03) << "mean " << sum / static_cast<double>(pixels);
}

TEST_P(OcclusionEverywhere, SurfacesOpenToAllSidesAreOpenByTheMethodsOwnCurve) {
  const auto values = drawn(testing_support::plane({0, 0}), {}, 0.05, display());
  double sum = 0;
  std::size_t inner = 0;
  for (int row = 18; row < 54; ++row) {
    for (int column = 24; column < 72; ++column) {
      const float value = values[static_cast<std::size_t>(row * 96 + column)];
      if (value < 0) continue;
      sum += value;
      ++inner;
    }
  }
  ASSERT_GT(inner, 1000U);
  // Samples of a sphere leave noise of one side: half of a binomial deviation of 8 samples is 0.07 (design
  // ambient-occlusion); 16 in the whole ball with a curve of power 5 leave more.
  const bool is_noisy = GetParam()->name == "sphere" || GetParam()->name == "crytek";
  EXPECT_LE(sum / static_cast<double>(inner), is_noisy ? 0.3 : 2.0 / 255) << GetParam()->name;
}

}  // namespace
}  // namespace lfd
