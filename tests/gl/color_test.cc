// Colour calibrations on the GPU: against their C++ twins, known answers, the planner, and what a viewer sees.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/srgb.h"
#include "calibration/make.h"
#include "calibration/make_color.h"
#include "controller/scene/made/made_scenes.h"
#include "rendernode/passes/gpu_colors.h"
#include "tests/gl/compute.h"
#include "tests/gl/picture_scene.h"
#include "tests/support/made.h"

namespace lfd {
namespace {

using namespace testing_support;
using reference::SceneMaker;

const std::string kHead =
    "#include \"shared/bindings.glsl\"\n#include \"shared/color_params.glsl\"\n#include \"lib/color.glsl\"\n"
    "layout(std430, binding = 2) readonly buffer Colors { ColorParams colors[]; };";

// Curves of every kind, a gain map, black levels, a full matrix; seeded.
ColorCalibration random_color(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  ColorCalibration color;
  color.gain = {5, 4, {}};
  for (int i = 0; i < 20; ++i) color.gain.node.emplace_back(unit(random), unit(random), 1.2 * unit(random));
  for (int c = 0; c < 3; ++c) {
    color.black_level[c] = 0.05 * unit(random);
    for (int r = 0; r < 3; ++r) color.device_from_display[c][r] = (c == r ? 1 : 0) + 0.2 * (unit(random) - 0.5);
  }
  std::vector<double> table(2 + 100 * (seed % 3));
  for (double& drive : table) drive = unit(random);
  std::ranges::sort(table);
  color.curve = {TransferCurve{SrgbCurve{}}, GammaCurve{1.8 + unit(random)}, TableCurve{table}};
  std::rotate(color.curve.begin(), color.curve.begin() + seed % 3, color.curve.end());
  return color;
}

// `body` for each input, with the parameters of the second of two modules as colors[0].
std::vector<glm::vec4> computed(const ColorCalibration& color, const std::string& body,
                                const std::vector<glm::vec4>& inputs) {
  std::vector<float> samples;
  color_params(random_color(99), samples);  // other modules' samples come first
  const shared::ColorParams params = color_params(color, samples);
  context();
  const gl::Buffer colors = gl::make_buffer(std::span(&params, 1)), buffer = gl::make_buffer(samples);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_COLOR_SAMPLES, buffer.name());
  return compute(kHead, body, inputs, 1, &colors);
}

std::vector<glm::vec4> random_inputs(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<glm::vec4> inputs;
  for (int i = 0; i < count; ++i) {
    const float x = unit(random), y = unit(random), z = unit(random);
    inputs.emplace_back(x, y, z, unit(random));
  }
  return inputs;
}

TEST(ColorTwins, Gains) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    const ColorCalibration color = random_color(seed);
    auto inputs = random_inputs(1000, seed);
    inputs.insert(inputs.end(), {{0, 0, 0, 0}, {1, 1, 0, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}});
    const auto found = computed(color, "b[0] = vec4(gain_at(colors[0], a.xy), 0.0);", inputs);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const glm::dvec3 expected = gain_at(color.gain, {1, 1}, {inputs[i].x, inputs[i].y});
      // The place, up to 4, is rounded; between nodes gains differ by up to 1.2.
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(found[i][c], expected[c], 3e-6) << "input " << i;
    }
  }
}

TEST(ColorTwins, Drives) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    const ColorCalibration color = random_color(seed);
    ColorCalibration linear = color;
    linear.curve.fill(GammaCurve{1});
    const auto inputs = random_inputs(2000, 10 + seed);
    const auto found = computed(color, "b[0] = vec4(drive_for(colors[0], vec3(a.w), 1.1 * a.rgb), 0.0);", inputs);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const glm::dvec3 light = 1.1 * glm::dvec3(inputs[i]), gain(inputs[i].w);
      const glm::dvec3 device = drive_for(linear, gain, light);
      for (int c = 0; c < 3; ++c) {
        // Ten roundings of numbers of about 1 before the curve, which is never falling but may be steep; then GLSL's
        // pow, some 2^-20 of its result.
        const auto drive = [&](double shift) {
          return drive_from_light(color.curve[static_cast<std::size_t>(c)], std::clamp(device[c] + shift, 0.0, 1.0));
        };
        ASSERT_GE(found[i][c], drive(-1.2e-6) - 2e-6) << "seed " << seed << ", input " << i;
        ASSERT_LE(found[i][c], drive(1.2e-6) + 2e-6) << "seed " << seed << ", input " << i;
      }
    }
  }
}

TEST(ColorTwins, EveryByteIsStoredAsItself) {
  std::vector<glm::vec4> inputs;
  for (int byte = 0; byte < 256; ++byte) {
    for (const double off : {-0.45, 0.0, 0.45})
      inputs.emplace_back(static_cast<float>(std::clamp((byte + off) / 255, 0.0, 1.0)), byte, 0, 0);
  }
  const auto found = computed(ColorCalibration{}, "b[0] = vec4(stored_as(vec3(a.x)), 0.0);", inputs);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    // Far from the half level at which the byte would be another.
    ASSERT_NEAR(255 * srgb_from_linear(found[i].x), inputs[i].y, 0.01);
  }
}

// One module that shows an unlit rectangle of this colour over its left half, before this background.
Shot shot_of(const ColorCalibration& color, glm::vec3 surface, glm::vec3 background) {
  DisplayCalibration display = centimetre_display();
  display.modules[0].color = color;
  SceneMaker maker;
  maker.add_mesh(rectangle(-1, -1, 0, 1), maker.add_material({.base_color = {surface.r, surface.g, surface.b, 1}}));
  proto::RenderSettings settings;
  settings.set_unlit(true);
  settings.mutable_background()->set_r(background.r);
  settings.mutable_background()->set_g(background.g);
  settings.mutable_background()->set_b(background.b);
  Renderer renderer(context(), display, {0});
  return Shot(draw_once(renderer, state_of(maker.data(), reference::same_spaces(), settings), maker.data().assets, {}));
}

constexpr PixelIndex kSurface{12, 20}, kBackground{50, 33};

void expect_bytes(const Levels& found, glm::dvec3 drive) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[static_cast<std::size_t>(c)], 255 * drive[c], 1) << "channel " << c;
}

float light_of_byte(int byte) { return static_cast<float>(linear_from_srgb(byte / 255.0)); }

// Colours that the G-buffer holds exactly.
const glm::vec3 kRed{light_of_byte(200), light_of_byte(100), light_of_byte(30)};
const glm::vec3 kGreen{light_of_byte(40), light_of_byte(150), light_of_byte(60)};

TEST(ColorKnownAnswers, AGainOfOneHalfHalvesLinearLight) {
  ColorCalibration color;
  color.gain.node[0] = glm::dvec3(0.5);
  const Shot shot = shot_of(color, kRed, kGreen);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(shot.color(kSurface)[static_cast<std::size_t>(c)], 255 * srgb_from_linear(0.5 * kRed[c]), 1);
    EXPECT_NEAR(shot.color(kBackground)[static_cast<std::size_t>(c)], 255 * srgb_from_linear(0.5 * kGreen[c]), 1);
  }
}

TEST(ColorKnownAnswers, AMatrixSwapsRedAndBlue) {
  ColorCalibration color;
  color.device_from_display = glm::dmat3({0, 0, 1}, {0, 1, 0}, {1, 0, 0});
  const Shot shot = shot_of(color, kRed, kGreen);
  expect_bytes(shot.color(kSurface), {30 / 255.0, 100 / 255.0, 200 / 255.0});
  expect_bytes(shot.color(kBackground), {60 / 255.0, 150 / 255.0, 40 / 255.0});
}

TEST(ColorKnownAnswers, AGammaReplacesTheCurveOfSrgb) {
  ColorCalibration color;
  color.curve.fill(GammaCurve{2.2});
  const Shot shot = shot_of(color, kRed, glm::vec3(0.5F));
  expect_bytes(shot.color(kSurface), {std::pow(kRed.r, 1 / 2.2), std::pow(kRed.g, 1 / 2.2), std::pow(kRed.b, 1 / 2.2)});
  expect_bytes(shot.color(kBackground), glm::dvec3(std::pow(0.5, 1 / 2.2)));
}

TEST(ColorKnownAnswers, ABlackLevelIsTakenAwayAndNothingGoesBelowIt) {
  ColorCalibration color;
  color.curve.fill(GammaCurve{1});
  color.black_level = glm::dvec3(0.1);
  const Shot shot = shot_of(color, glm::vec3(1), glm::vec3(0.3F, 0.1F, 0));
  expect_bytes(shot.color(kSurface), glm::dvec3(0.9));
  expect_bytes(shot.color(kBackground), {0.2, 0, 0});
}

// Everything at once, at every pixel, by the equation in C++; of the background, since software rasterisers decode the
// sRGB of surfaces with an error of up to 0.0012 of full light, which the steep curves here make more of.
TEST(ColorKnownAnswers, EveryPixelIsThatOfTheEquation) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    const ColorCalibration color = random_color(seed);
    const Shot shot = shot_of(color, kRed, kGreen);
    for (int row = 0; row < 48; ++row) {
      for (int column = 33; column < 64; ++column) {
        const glm::dvec3 gain = gain_at(color.gain, {64, 48}, centre_of({column, row}));
        expect_bytes(shot.color({column, row}), drive_for(color, gain, kGreen));
      }
    }
  }
}

// Of a few small modules; module 1 has no colour calibration.
DisplayCalibration plain_display() {
  DisplayCalibration display = *make_display("desk", 4);
  display.image = {96, 72};
  return display;
}

DisplayCalibration colored_display() {
  DisplayCalibration display = colored(plain_display(), 11);
  display.modules[1].color.reset();
  display.modules[2].color = random_color(1);
  return display;
}

RegionOfInterest on_screen(const SceneData& data, const DisplayCalibration& display) {
  const auto &low = data.scene.bounds_low(), &high = data.scene.bounds_high();
  return fit_to_screen({low.x(), low.y(), low.z()}, {high.x(), high.y(), high.z()}, display.screen.width_m,
                       display.screen.height_m);
}

FrameResult drawn(const DisplayCalibration& display, const SceneData& data, const RegionOfInterest& roi,
                  const proto::RenderSettings& settings) {
  std::vector<std::uint32_t> modules(display.modules.size());
  for (std::uint32_t k = 0; k < modules.size(); ++k) modules[k] = k;
  Renderer renderer(context(), display, modules);
  return draw_once(renderer, state_of(data, roi, settings), data.assets, {});
}

const ModuleImage& color_of(const FrameResult& result, std::uint32_t module) {
  const ModuleImage* image = find_image(result, module, proto::COLOR);
  LFD_CHECK(image != nullptr, "every module has a colour");
  return *image;
}

TEST(ColorPlanner, PicturesAreThoseOfEverythingAndOfOtherModulesAsBefore) {
  for (const char* name : {"room", "depth-steps"}) {  // lit, unlit
    const SceneData data = made_data(name);
    auto both = both_plans();
    for (auto& settings : both) settings.mutable_ao()->set_enabled(false);
    const RegionOfInterest roi = on_screen(data, plain_display());
    const FrameResult planned = drawn(colored_display(), data, roi, both[0]);
    const FrameResult everything = drawn(colored_display(), data, roi, both[1]);
    const FrameResult plain = drawn(plain_display(), data, roi, both[0]);
    for (std::uint32_t k = 0; k < 4; ++k) {
      ASSERT_FALSE(color_of(planned, k).empty || color_of(everything, k).empty);
      EXPECT_TRUE(*color_of(planned, k).bytes == *color_of(everything, k).bytes) << name << ", module " << k;
      EXPECT_EQ(*color_of(planned, k).bytes == *color_of(plain, k).bytes, k == 1) << name << ", module " << k;
    }
  }
}

TEST(ColorPlanner, ModulesWithColourThatSeeNothingShowTheBackgroundInTheirColour) {
  const DisplayCalibration display = colored_display();
  const SceneData data = made_data("depth-steps");
  RegionOfInterest roi = on_screen(data, display);
  roi.physical_centre.y = 5;  // far above the screen
  proto::RenderSettings settings;
  settings.mutable_background()->set_g(0.3F);
  const FrameResult result = drawn(display, data, roi, settings);
  EXPECT_TRUE(color_of(result, 1).empty);
  for (const std::uint32_t k : {0U, 2U, 3U}) {
    ASSERT_FALSE(color_of(result, k).empty);
    const ColorCalibration& color = *display.modules[k].color;
    const std::string& bytes = *color_of(result, k).bytes;
    for (int pixel = 0; pixel < 96 * 72; ++pixel) {
      const glm::dvec3 gain = gain_at(color.gain, display.image, centre_of({pixel % 96, pixel / 96}));
      const glm::dvec3 drive = drive_for(color, gain, {0, 0.3, 0});
      for (int c = 0; c < 3; ++c) {
        ASSERT_NEAR(static_cast<std::uint8_t>(bytes[static_cast<std::size_t>(4 * pixel + c)]), 255 * drive[c], 1);
      }
    }
  }
}

}  // namespace
}  // namespace lfd
