// Ambient occlusion's known answers beside its limit: open planes, falling errors, curve, targets.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "calibration/make.h"
#include "tests/gl/ao_scenes.h"

namespace lfd {
namespace {

using testing_support::all_generators;
using testing_support::AoPixel;
using testing_support::AoStage;
using testing_support::ball_stage;
using testing_support::floats;
using testing_support::from_above;
using testing_support::inner;
using testing_support::made;
using testing_support::plain_ao;
using testing_support::plane;

struct View {
  const char* name;
  DisplayCalibration display;
  std::uint32_t module;
};

std::vector<View> views() {
  const auto made = [](const char* name) {
    auto display = make_display(name, 4);
    LFD_CHECK(display, display.error().message());
    display->image = {128, 96};
    return *display;
  };
  return {{"linear, ideal", made("640rc"), 0},
          {"linear, perturbed", perturbed(made("640rc"), 3), 1},
          {"conical", reference::one_module(Diffuser::kConical, {128, 96}), 0},
          {"conical, perturbed", perturbed(reference::one_module(Diffuser::kConical, {128, 96}), 5), 0}};
}

// A sample that lies within rounding of the plane may fall to the wrong side: the surface between four pixels is
// interpolated, and the map bends. So one pair in ten thousand is hidden or open as a whole; the pixels near it are
// counted, and their mean bounded.
TEST(AmbientOcclusion, AnOpenPlaneIsOpenWithPointSymmetricSamples) {
  constexpr double kR = 0.1, kOneLevel = 1.0 / 255;
  for (const View& view : views()) {
    for (const glm::vec2 slope : {glm::vec2(0, 0), glm::vec2(0.3, -0.2)}) {
      AoStage stage(plane(slope), reference::same_spaces(), view.display, view.module);
      for (const auto generator : all_generators()) {
        proto::AmbientOcclusion ao;  // curve, blur and number of samples as they are by default
        ao.set_radius_m(kR);
        ao.set_generator(generator);
        (*ao.mutable_parameter())["symmetric"] = 1;
        ao.set_radii(slope.x == 0 ? 3 : 1);
        const auto pixels = inner(stage, stage.draw(ao), kR);
        ASSERT_GT(pixels.size(), 1000U);
        double sum = 0;
        std::size_t over = 0;
        for (const AoPixel& pixel : pixels) {
          sum += pixel.ao / static_cast<double>(pixels.size());
          over += std::abs(pixel.ao) > kOneLevel ? 1 : 0;
        }
        const auto which = std::string(view.name) + ", " + proto::AmbientOcclusion::Generator_Name(generator);
        EXPECT_LE(sum, kOneLevel) << which;
        if (slope.x == 0) {
          EXPECT_EQ(over, 0U) << which;
        } else {
          EXPECT_LE(over, pixels.size() / 100) << which;
        }
      }
    }
  }
}

// Share of the shell that is under the floor or behind a wall at distance d (as in
// tests/unit/reference_ao_limit_test.cc).
double hidden_at_foot(double d, double radius, double shell) {
  const int steps = 1000;
  double open = 0;
  for (int i = 0; i < steps; ++i) {
    const double t = shell * shell * shell + (1 - shell * shell * shell) * (i + 0.5) / steps;
    open += 0.25 * (1 + std::min(d / (radius * std::cbrt(t)), 1.0)) / steps;
  }
  return 1 - open;
}

// Slope of a straight line fitted to y over x = 0, 1, 2, ...
double slope_of(const std::vector<double>& y) {
  const double n = static_cast<double>(y.size()), middle = (n - 1) / 2;
  double above = 0, below = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    above += (static_cast<double>(i) - middle) * y[i];
    below += (static_cast<double>(i) - middle) * (static_cast<double>(i) - middle);
  }
  return above / below;
}

TEST(AmbientOcclusion, TheErrorFallsAsOneOverTheRootOfTheSampleCount) {
  constexpr double kR = 0.12, kWallZ = -0.45, kFloorY = -0.45;
  AoStage wall(made("wall"), from_above(), reference::one_module(Diffuser::kLinear, {128, 96}));
  std::map<proto::AmbientOcclusion::Generator, double> slope, last;
  for (const auto generator : all_generators()) {
    std::vector<double> log4_rms;
    for (const int samples : {4, 16, 64, 256}) {
      double squares = 0;
      int count = 0;
      for (std::uint32_t seed = 1; seed <= 8; ++seed) {
        auto ao = plain_ao(kR, samples, generator);
        ao.set_seed(seed);
        for (const AoPixel& pixel : wall.draw(ao)) {
          const double d = pixel.p.z - kWallZ;
          if (std::abs(pixel.p.y - kFloorY) > 1e-4 || d > kR || std::abs(pixel.p.x + 0.4) > 0.2) continue;
          squares += std::pow(pixel.ao - hidden_at_foot(d, kR, 0.8), 2);
          ++count;
        }
      }
      ASSERT_GT(count, 1000);
      last[generator] = std::sqrt(squares / count);
      log4_rms.push_back(std::log(last[generator]) / std::log(4.0));
    }
    slope[generator] = slope_of(log4_rms);
  }
  // Eight sets of four samples know their variance to about 17 %, which moves the slope by 0.02; at 256 samples the
  // grid of pixels (at most 28 of 600 pixels of the sphere, see ao_limit_test.cc) adds 0.013 to 0.03 in squares, which
  // moves it by 0.02.
  EXPECT_NEAR(slope[proto::AmbientOcclusion::UNIFORM], -0.5, 0.06);
  for (const auto generator : all_generators()) {
    EXPECT_LT(slope[generator], -0.44) << proto::AmbientOcclusion::Generator_Name(generator);
    EXPECT_LT(last[generator], 1.05 * last[proto::AmbientOcclusion::UNIFORM])
        << proto::AmbientOcclusion::Generator_Name(generator);
  }
}

double curve(double ao, double a, double b, double c) {
  return 1 - std::pow(std::clamp(b * (1 - ao + a), 0.0, 1.0), c);
}

double linear_of(char level) { return reference::linear_from_srgb(static_cast<std::uint8_t>(level) / 255.0); }

struct Lit {
  AoTarget target;
  double a, b, c;
};

TEST(AmbientOcclusion, CurveAndTargetReachTheColour) {
  AoStage stage = ball_stage();
  const auto plain = plain_ao(0.1, 8, proto::AmbientOcclusion::POISSON_DISK);
  const auto share = floats(stage.draw_buffers(plain), proto::AO);
  auto off = plain;
  off.set_enabled(false);
  const FrameResult unoccluded = stage.draw_buffers(off);
  const auto& bright = *testing_support::find_image(unoccluded, 0, proto::COLOR)->bytes;
  constexpr double ambient[] = {0.5, 0.4, 0.3};
  for (const Lit& lit : {Lit{AoTarget::kAmbientLight, 0.5, 1, 1}, Lit{AoTarget::kAmbientLight, 0, 1.03, 4},
                         Lit{AoTarget::kWholeColor, 0, 1, 1}, Lit{AoTarget::kWholeColor, 0.5, 1, 2}}) {
    auto ao = plain;
    ao.mutable_curve()->set_a(lit.a);
    ao.mutable_curve()->set_b(lit.b);
    ao.mutable_curve()->set_c(lit.c);
    if (lit.target == AoTarget::kWholeColor) ao.set_target(proto::AmbientOcclusion::WHOLE_COLOR);
    const FrameResult result = stage.draw_buffers(ao);
    const auto curved = floats(result, proto::AO);
    const auto& color = *testing_support::find_image(result, 0, proto::COLOR)->bytes;
    for (std::size_t i = 0; i < share.size(); i += 4) {
      if (share[i + 3] == 0) continue;
      const double expected = curve(share[i], lit.a, lit.b, lit.c);
      ASSERT_NEAR(curved[i], expected, 1e-6) << "a float's rounding";
      for (std::size_t channel = 0; channel < 3; ++channel) {
        // Both pictures are rounded to 8 bits; a level is at most 2.3 / 255 of linear light.
        const double all = linear_of(bright[i + channel]), open = 1 - expected;
        const double linear = lit.target == AoTarget::kWholeColor ? all * open : all - ambient[channel] * (1 - open);
        ASSERT_NEAR(linear_of(color[i + channel]), linear, 2.3 / 255) << "pixel " << i / 4 << ", channel " << channel;
      }
    }
  }
}

TEST(AmbientOcclusion, SwitchedOffEveryPixelIsAsIfItWereOpen) {
  AoStage stage = ball_stage();
  auto off = plain_ao(0.1, 8, proto::AmbientOcclusion::UNIFORM);
  off.set_enabled(false);
  auto open = plain_ao(0.1, 8, proto::AmbientOcclusion::UNIFORM);
  open.mutable_curve()->set_a(1);  // 1 - ao + 1 >= 1: the curve opens everything
  const FrameResult without = stage.draw_buffers(off), with = stage.draw_buffers(open);
  EXPECT_EQ(floats(without, proto::AO), floats(with, proto::AO));
  EXPECT_EQ(*testing_support::find_image(without, 0, proto::COLOR)->bytes,
            *testing_support::find_image(with, 0, proto::COLOR)->bytes);
  EXPECT_EQ(floats(without, proto::POSITION), floats(with, proto::POSITION));
}

}  // namespace
}  // namespace lfd
