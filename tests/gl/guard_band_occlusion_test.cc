// Guard bands: what lies just outside of the module's image changes its ambient occlusion at the border, and nowhere
// else.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "tests/gl/guard_band_scene.h"

namespace lfd {
namespace {

using namespace testing_support::guard_band;
using reference::SceneMaker;
using testing_support::AoStage;

// Shares of hidden samples of the pixels for which `wanted(column, row)` holds, NaN where there is no surface.
template <class Wanted>
std::vector<float> occlusion(const FrameResult& result, ImageSize size, Wanted wanted) {
  const auto all = buffer(result, proto::AO);
  std::vector<float> chosen;
  for (int row = 0; row < size.height; ++row) {
    for (int column = 0; column < size.width; ++column) {
      const std::size_t i = 4 * (static_cast<std::size_t>(row) * size.width + column);
      if (wanted(column, row)) chosen.push_back(all[i + 3] == 0 ? std::nanf("") : all[i]);
    }
  }
  return chosen;
}

struct Difference {
  std::size_t pixels = 0, differ = 0;  // by more than 1e-3; where one of both has no surface
  double mean = 0;
};

Difference difference(const std::vector<float>& one, const std::vector<float>& other) {
  LFD_CHECK(one.size() == other.size(), "the same pixels");
  Difference found;
  for (std::size_t i = 0; i < one.size(); ++i) {
    if (std::isnan(one[i]) && std::isnan(other[i])) continue;
    ++found.pixels;
    const double off = std::abs(one[i] - other[i]);
    if (!(off <= 1e-3)) ++found.differ;
    if (!std::isnan(off)) found.mean += off;
  }
  found.mean /= static_cast<double>(found.pixels);
  return found;
}

class GuardBandWith : public testing::TestWithParam<const occlusion::Method*> {};
INSTANTIATE_TEST_SUITE_P(Methods, GuardBandWith,
                         testing::ValuesIn(occlusion::methods().begin(), occlusion::methods().end()),
                         [](const auto& method) { return std::string(method.param->name); });

TEST_P(GuardBandWith, FarFromTheBorderOcclusionIsThatWithout) {
  const DisplayCalibration display = perturbed(desk({129, 97}), 8);
  const auto inner = [](int column, int row) { return std::min({column, row, 128 - column, 96 - row}) >= 24; };
  for (const bool half : {false, true}) {
    auto settings = settings_of(std::string(GetParam()->name), 0);
    settings.mutable_ao()->set_half_resolution(half);
    const auto without = occlusion(drawn(display, settings), display.image, inner);
    const auto with = occlusion(drawn(display, with_band(settings, kBand_px - 1)), display.image, inner);
    const Difference found = difference(without, with);
    ASSERT_GT(found.pixels, 3000U);
    // Samples within rounding of a surface may turn. Means of 3 x 3 pixels are those of others: 16 is no multiple of 3.
    const bool is_averaged = GetParam()->pyramid == occlusion::Pyramid::kAveraged;
    EXPECT_LE(found.differ, found.pixels / (is_averaged ? 10 : 1000)) << (half ? "half" : "full") << " resolution";
    EXPECT_LE(found.mean, is_averaged ? 1e-3 : 1e-5);
  }
}

// The same display made larger by hand: screen and image go on beside their borders.
DisplayCalibration larger_by(DisplayCalibration display, int px) {
  const ImageSize before = display.image;
  display.image = {before.width + 2 * px, before.height + 2 * px};
  display.screen.width_m *= static_cast<double>(display.image.width) / before.width;
  display.screen.height_m *= static_cast<double>(display.image.height) / before.height;
  return display;
}

// Pixels of the module's image that lie less than `px` from its border, in a picture with `shift` more on every side.
std::vector<float> at_border(const FrameResult& result, ImageSize image, int px, int shift) {
  return occlusion(result, {image.width + 2 * shift, image.height + 2 * shift}, [&](int column, int row) {
    const int u = column - shift, v = row - shift;
    const int from_border = std::min({u, v, image.width - 1 - u, image.height - 1 - v});
    return from_border >= 0 && from_border < px;
  });
}

// The noise of the larger image differs, of which many samples leave little.
TEST(GuardBand, AtTheBorderOcclusionIsThatOfALargerImage) {
  const DisplayCalibration display = desk({96, 72});
  for (const char* method : {"march", "sphere"}) {
    auto settings = settings_of(method, 0);
    settings.mutable_ao()->set_samples(256);
    const auto without = at_border(drawn(display, settings), display.image, 4, 0);
    const auto with = at_border(drawn(display, with_band(settings, kBand_px)), display.image, 4, 0);
    const auto expected = at_border(drawn(larger_by(display, 20), settings), display.image, 4, 20);
    const Difference banded = difference(with, expected), cut = difference(without, expected);
    ASSERT_GT(banded.pixels, 800U);
    EXPECT_LT(banded.mean, 0.002) << method;
    EXPECT_LT(banded.mean, 0.2 * cut.mean) << method;
  }
}

// Where images reach beyond the screen, viewers see no further than that, but occlusion does.
TEST(GuardBand, AtTheScreensBorderWithinTheImageOcclusionIsThatOfALargerScreen) {
  const DisplayCalibration display = overshooting(desk({128, 96}));
  DisplayCalibration expecting = display;
  expecting.screen.width_m *= 1.25;  // the image goes on to 4/3 of it
  expecting.screen.height_m *= 1.25;
  auto settings = settings_of("march", 0);
  settings.mutable_ao()->set_samples(256);
  settings.mutable_ao()->mutable_blur()->set_enabled(false);  // it takes in what is seen
  const auto near_border = [](int column, int row) {          // of the screen, at pixels 16 to 112 and 12 to 84
    const int from_border = std::min({column - 16, row - 12, 111 - column, 83 - row});
    return from_border >= 0 && from_border < 4;
  };
  const auto without = occlusion(drawn(display, settings), display.image, near_border);
  const auto with = occlusion(drawn(display, with_band(settings, 16)), display.image, near_border);
  const auto expected = occlusion(drawn(expecting, settings), display.image, near_border);
  const Difference banded = difference(with, expected), cut = difference(without, expected);
  EXPECT_LT(banded.mean, 0.2 * cut.mean);
  EXPECT_GT(cut.mean, 0.001);
}

// A step stands on the last line of pixels to the right, just outside of the image; the emitter is straight behind it.
TEST(GuardBand, AWallJustOutsideOfTheImageDarkensItsFoot) {
  DisplayCalibration display = reference::one_module(Diffuser::kLinear, {96, 72});
  display.modules[0].emitter.x = 0.5 * display.screen.width_m;
  constexpr float kFoot = 0.82F, kFloor = -0.1F, kTop = -0.04F;
  SceneMaker maker;
  const auto white = maker.add_material({});
  maker.add_quad({-1.5F, -1.2F, kFloor}, {kFoot, -1.2F, kFloor}, {kFoot, 1.2F, kFloor}, {-1.5F, 1.2F, kFloor}, white);
  maker.add_quad({kFoot, -1.2F, kFloor}, {kFoot, -1.2F, kTop}, {kFoot, 1.2F, kTop}, {kFoot, 1.2F, kFloor}, white);
  maker.add_quad({kFoot, -1.2F, kTop}, {1.5F, -1.2F, kTop}, {1.5F, 1.2F, kTop}, {kFoot, 1.2F, kTop}, white);
  auto settings = settings_of("march", 0);
  settings.mutable_ao()->set_samples(256);
  settings.mutable_ao()->mutable_blur()->set_enabled(false);
  (*settings.mutable_ao()->mutable_parameter())["steps"] = 16;
  const AoSettings ao = value(read_settings(settings)).ao;
  const AoStage unlimited(maker.data(), reference::same_spaces(), larger_by(display, 32));
  const FrameResult cut = drawn(display, settings, maker.data());
  const FrameResult banded = drawn(display, with_band(settings, kBand_px), maker.data());
  constexpr int kRow = 36;
  for (int from_border = 0; from_border < 4; ++from_border) {
    const int column = display.image.width - 1 - from_border;
    const auto mean = [&](const FrameResult& result) {
      const auto of_column = [&](int u, int v) { return u == column && std::abs(v - kRow) < 8; };
      const auto values = occlusion(result, display.image, of_column);
      return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    };
    const double limit = unlimited.method_limit({column + 32, kRow + 32}, ao, kRadius, {}).value();
    EXPECT_EQ(mean(cut), 0) << "nothing stands in the image";
    // The step is drawn up to half a pixel nearer than it is, a sixteenth of the radius.
    EXPECT_NEAR(mean(banded), limit, 0.03) << from_border;
    if (from_border < 3) {
      EXPECT_LT(std::abs(mean(banded) - limit), limit) << "nearer than without, " << from_border;
    }
  }
}

}  // namespace
}  // namespace lfd
