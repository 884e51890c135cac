// Guard bands: what is seen is what is seen without, whatever changes at run time.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>

#include "calibration/make_color.h"
#include "tests/gl/guard_band_scene.h"

namespace lfd {
namespace {

using namespace testing_support::guard_band;
using reference::SceneMaker;
using testing_support::buffers;
using testing_support::context;
using testing_support::draw_once;
using testing_support::find_image;
using testing_support::state_of;

struct View {
  const char* name;
  DisplayCalibration display;
};

std::vector<View> views() {
  const ImageSize size{129, 97};  // odd: half the resolution has a sample in the last column and row
  const DisplayCalibration ideal = desk(size);
  return {{"Ideal", ideal},
          {"Homography", with_homographies(ideal, {1.05, 0.02, 3e-5, -0.03, 0.97, -2e-5, 3, -2, 1})},
          {"Overshooting", overshooting(ideal)},
          {"Pinhole", perturbed(ideal, 3)},
          {"Grid", value(measured(perturbed(ideal, 4), 24, 18, 1.0, 2))},
          {"Curved", value(curved(ideal, 1.5, false))},
          {"CurvedPinhole", value(curved(perturbed(ideal, 5), -4, true))},
          {"Conical", reference::one_module(Diffuser::kConical, size)},
          {"ConicalPinhole", perturbed(reference::one_module(Diffuser::kConical, size), 6)}};
}

class GuardBandOn : public testing::TestWithParam<View> {};
INSTANTIATE_TEST_SUITE_P(Displays, GuardBandOn, testing::ValuesIn(views()),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

// The numbers of a pixel differ by more than rounding: positions and depths of surfaces that are 3 m away from the
// observers are floats in both pictures, normals half floats. Colours are rounded to bytes twice, as albedo and lit; a
// GPU may interpolate a vertex colour near half a step now to one side and now to the other.
bool differs(proto::BufferKind kind, const float* one, const float* other) {
  const double tolerance = kind == proto::COLOR ? 2.01 / 255 : kind == proto::NORMAL ? 2.0 / 1024 : 1e-4;
  for (int k = 0; k < 4; ++k) {
    if (!(std::abs(one[k] - other[k]) <= tolerance)) return true;
  }
  return false;
}

// Rasterisers bring corners to a grid of 1/256 of a pixel, to which pixels of an outline are near now and then: of
// `share` of all they may show another surface.
void expect_same(const FrameResult& one, const FrameResult& other, std::uint32_t module = 0, double share = 1e-3) {
  for (const auto kind : kAllKinds) {
    const auto a = buffer(one, kind, module), b = buffer(other, kind, module);
    ASSERT_EQ(a.size(), b.size());
    std::size_t differ = 0;
    std::map<int, int> by_size;
    for (std::size_t i = 0; i < a.size(); i += 4) {
      if (!differs(kind, &a[i], &b[i])) continue;
      ++differ;
      float most = 0;
      for (int k = 0; k < 4; ++k) most = std::max(most, std::abs(a[i + k] - b[i + k]));
      ++by_size[static_cast<int>(std::lround(most * 255))];
    }
    EXPECT_LE(static_cast<double>(differ), share * static_cast<double>(a.size() / 4))
        << proto::BufferKind_Name(kind) << ", by 255ths: " << testing::PrintToString(by_size);
  }
}

TEST_P(GuardBandOn, SurfacesAndColoursAreThoseWithout) {
  const DisplayCalibration& display = GetParam().display;
  const auto settings = opened(settings_of("sphere", 0));
  const FrameResult without = drawn(display, settings);
  for (const int px : {1, kBand_px}) expect_same(without, drawn(display, with_band(settings, px)));
  const auto surfaces = buffer(without, proto::POSITION);
  EXPECT_GT(seen_pixels(surfaces), surfaces.size() / 4 / 3);
  EXPECT_LT(seen_pixels(surfaces), surfaces.size() / 4) << "there are holes";
}

std::vector<std::uint32_t> all_of(const DisplayCalibration& display) {
  std::vector<std::uint32_t> modules(display.modules.size());
  std::iota(modules.begin(), modules.end(), 0U);
  return modules;
}

TEST(GuardBand, OfSeveralModulesEachIsThatOfTheModuleAlone) {
  const DisplayCalibration display = perturbed(desk({64, 48}), 9);
  const auto settings = settings_of("sphere", kBand_px);
  Renderer together(context(), display, all_of(display));
  const FrameResult all = drawn(together, settings);
  for (std::uint32_t module = 0; module < display.modules.size(); ++module) {
    Renderer alone(context(), display, {module});
    const FrameResult one = drawn(alone, settings);
    // Edges are split as all modules of a node need it: outlines and creases differ by what that leaves, 0.02 px.
    expect_same(all, one, module, 5e-3);
  }
}

TEST(GuardBand, MapsGainsOfColourToTheImageWithoutIt) {
  const DisplayCalibration display = colored(desk({128, 96}), 4);
  const auto settings = opened(settings_of("sphere", 0));
  const FrameResult without = drawn(display, settings), with = drawn(display, with_band(settings, 32));
  expect_same(without, with);
  const auto uncorrected = buffer(drawn(desk({128, 96}), settings), proto::COLOR), color = buffer(with, proto::COLOR);
  EXPECT_NE(uncorrected, color);
}

// Its picture has no surface, and the report says why.
TEST(GuardBand, AModuleThatSeesGeometryInTheBandAloneShowsTheBackground) {
  const DisplayCalibration display = reference::one_module(Diffuser::kLinear, {96, 72});
  SceneMaker maker;  // 2 to 8 pixels right of the screen's border
  maker.add_quad({0.83F, -0.3F, 0}, {0.93F, -0.3F, 0}, {0.93F, 0.3F, 0}, {0.83F, 0.3F, 0}, maker.add_material({}));
  for (const bool plan : {true, false}) {
    auto settings = settings_of("sphere", kBand_px);
    settings.mutable_background()->set_r(0.5);
    if (!plan) settings.set_planner(proto::RenderSettings::EVERYTHING);
    const FrameResult result = drawn(display, settings, maker.data());
    for (const auto kind : kAllKinds) {
      const ModuleImage* image = find_image(result, 0, kind);
      ASSERT_NE(image, nullptr);
      ASSERT_EQ(image->empty, plan);
      if (plan) continue;
      const auto values = buffer(result, kind);
      for (std::size_t i = 0; i < values.size(); i += 4) {
        const float red = kind == proto::COLOR ? 188.0F / 255 : 0;  // 0.5 by the sRGB transfer
        ASSERT_NEAR(values[i], red, 1.01 / 255) << proto::BufferKind_Name(kind);
        ASSERT_EQ(values[i + 3], kind == proto::COLOR ? 1 : 0);
      }
    }
  }
}

TEST(GuardBand, ThatIsTooLargeIsRefusedAndTheRunningStateGoesOn) {
  const DisplayCalibration display = reference::one_module(Diffuser::kLinear, {8190, 2});
  Renderer renderer(context(), display, {0});
  const SceneData data = scene_beyond_the_borders();
  const FrameResult before = drawn(renderer, settings_of("sphere", 0));
  const Status refused =
      renderer.set_state(state_of(data, reference::same_spaces(), settings_of("sphere", 2)), data.assets);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message(),
            "ao.guard_band_px: images of 8190x2 px become 8194x6 with a guard band of 2 px; at most 8192 px a side are "
            "possible");
  ASSERT_TRUE(renderer.draw({.buffers = {}, .reuse = false}));
  EXPECT_EQ(buffer(renderer.collect(), proto::COLOR), buffer(before, proto::COLOR));
}

// Bit by bit: whatever was drawn before.
TEST(GuardBand, ChangesAtRunTime) {
  const DisplayCalibration display = value(measured(desk({64, 48}), 12, 9, 1.0, 2));
  Renderer renderer(context(), display, {0, 1, 2});
  auto off = settings_of("march", kBand_px);
  off.mutable_ao()->set_enabled(false);
  const std::vector<proto::RenderSettings> states{
      settings_of("march", 0), settings_of("march", 16), off, settings_of("march", 16), settings_of("hbao", 16),
      settings_of("hbao", 6),  settings_of("march", 0)};
  for (std::size_t i = 0; i < states.size(); ++i) {
    const FrameResult changed = drawn(renderer, states[i]);
    Renderer fresh(context(), display, {0, 1, 2});
    const FrameResult expected = drawn(fresh, states[i]);
    for (const std::uint32_t module : {0U, 1U, 2U}) {
      for (const auto kind : kAllKinds)
        EXPECT_EQ(buffer(changed, kind, module), buffer(expected, kind, module)) << "state " << i;
    }
  }
}

// Also where no light reads ambient occlusion: then there is no band.
TEST(GuardBand, PicturesArePlannedAsThoseOfEverything) {
  const DisplayCalibration display = desk({64, 48});
  for (const bool unlit : {false, true}) {
    auto planned = settings_of("sphere", kBand_px);
    planned.set_unlit(unlit);
    auto everything = planned;
    everything.set_planner(proto::RenderSettings::EVERYTHING);
    const SceneData data = scene_beyond_the_borders();
    for (const auto& kinds : {buffers({proto::POSITION, proto::NORMAL, proto::AO}), BufferSet{}}) {
      Renderer one(context(), display, {0}), other(context(), display, {0});
      const auto a = draw_once(one, state_of(data, {}, planned), data.assets, {.buffers = kinds});
      const auto b = draw_once(other, state_of(data, {}, everything), data.assets, {.buffers = kinds});
      ASSERT_EQ(a.images.size(), b.images.size());
      for (std::size_t i = 0; i < a.images.size(); ++i) EXPECT_EQ(*a.images[i].bytes, *b.images[i].bytes);
    }
  }
}

}  // namespace
}  // namespace lfd
