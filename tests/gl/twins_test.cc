// GPU functions equal their C++ twins: optics, maps, hashes, rotations, curve and lights.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>

#include "bench/reference/ao_limit.h"
#include "bench/reference/scene_maker.h"
#include "calibration/make.h"
#include "rendernode/passes/gpu_modules.h"
#include "tests/gl/compute.h"

namespace lfd {
namespace {

using testing_support::compute;

constexpr float kEpsilon = std::numeric_limits<float>::epsilon();

// Displays of every kind of map and both diffusers, at random places; seeded.
std::vector<DisplayCalibration> random_displays() {
  std::mt19937 random(11);
  const auto about = [&](double value, double spread) {
    return value + std::uniform_real_distribution<double>(-spread, spread)(random);
  };
  std::vector<DisplayCalibration> displays;
  for (int i = 0; i < 18; ++i) {
    DisplayCalibration display;
    display.screen = {about(1.6, 0.5), about(1.0, 0.3)};
    display.image = {1024, 768};
    display.optics = {i % 2 == 0 ? Diffuser::kLinear : Diffuser::kConical, about(0, 0.4), about(3, 1)};
    display.modules.push_back({{about(0, 1), about(0, 0.6), about(-2, 0.8)}, IdealMap{}});
    if (i % 3 == 1) {
      // The ideal map, turned, sheared and keystoned a little.
      const ScreenSize s = display.screen;
      HomographyMap map;
      const double w = 1024 / s.width_m, h = 768 / s.height_m;
      map.image_from_screen =
          glm::transpose(glm::dmat3(w * about(1, 0.05), w * about(0, 0.05), about(512, 20), h * about(0, 0.05),
                                    -h * about(1, 0.05), about(384, 20), about(0, 0.05), about(0, 0.05), 1));
      display.modules[0].map = map;
    }
    if (i % 3 == 2) display = perturbed(display, static_cast<std::uint64_t>(i));
    displays.push_back(display);
  }
  return displays;
}

const std::string kMapHead =
    "#include \"shared/module_params.glsl\"\n#include \"lib/optics.glsl\"\n#include \"lib/image_map.glsl\"\n"
    "layout(std430, binding = 2) readonly buffer Modules { ModuleParams modules[]; };";

gl::Buffer module_buffer(const DisplayCalibration& display) {
  const shared::ModuleParams params = module_params(display, display.modules[0], nullptr, {});
  return gl::make_buffer(std::span(&params, 1));
}

std::vector<glm::vec4> random_points(int count, glm::vec3 low, glm::vec3 high, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<glm::vec4> points;
  for (int i = 0; i < count; ++i) {
    const float x = unit(random), y = unit(random), z = unit(random);
    points.emplace_back(low + (high - low) * glm::vec3(x, y, z), 0);
  }
  return points;
}

// How far the pixel of a point moves when each of its coordinates and everything computed on the way is off by one
// float epsilon of the sizes involved: the map's own steepness, by differences in double.
std::optional<double> pixels_per_metre(const DisplayCalibration& display, Point3<Physical> p) {
  const double h = 1e-4;
  const auto at = image_from_physical(display, display.modules[0], p);
  double steepest = 0;
  for (const Vector3<Physical>& d : {Vector3<Physical>{h, 0, 0}, {0, h, 0}, {0, 0, h}}) {
    const auto moved = image_from_physical(display, display.modules[0], p + d);
    if (!at || !moved) return std::nullopt;
    steepest = std::max(steepest, std::hypot(moved->u - at->u, moved->v - at->v) / h);
  }
  return steepest;
}

TEST(Twins, ImageFromPhysical) {
  int compared = 0, disagreements = 0;
  double worst = 0;
  for (const DisplayCalibration& display : random_displays()) {
    const gl::Buffer modules = module_buffer(display);
    const double vz = display.optics.observer_distance_m, ez = display.modules[0].emitter.z;
    const auto inputs = random_points(4000, {-1.5, -1, 1.05 * ez}, {1.5, 1, 1.05 * vz}, 1);
    const auto found = compute(kMapHead, "b[0] = image_from_physical(modules[0], a.xyz);", inputs, 1, &modules);
    ASSERT_EQ(found.size(), inputs.size());
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const Point3<Physical> p{inputs[i].x, inputs[i].y, inputs[i].z};
      const auto expected = image_from_physical(display, display.modules[0], p);
      if (expected.has_value() != (found[i].w == 1)) {
        ++disagreements;
        continue;
      }
      const auto slope = expected ? pixels_per_metre(display, p) : std::nullopt;
      if (!slope) continue;
      ++compared;
      // About 20 operations on lengths of up to 4 m, each of half an epsilon, arrive at the point's place in space; the
      // rest of the way works on pixels up to 1024.
      const double tolerance = kEpsilon * (20 * 0.5 * 4 * *slope + 10 * 1024);
      const double error = std::hypot(found[i].x - expected->u, found[i].y - expected->v);
      worst = std::max(worst, error / tolerance);
      ASSERT_LE(error, tolerance) << "at " << p.x << " " << p.y << " " << p.z;
      ASSERT_EQ(found[i].z, inputs[i].z);
    }
  }
  EXPECT_GT(compared, 5000);
  EXPECT_LE(disagreements, compared / 1000) << "only on the very border of screen and image may they differ";
  RecordProperty("worst_share_of_tolerance_percent", static_cast<int>(100 * worst));
}

TEST(Twins, ScreenFromImageAndTheLinesDirection) {
  for (const DisplayCalibration& display : random_displays()) {
    if (std::holds_alternative<PinholeMap>(display.modules[0].map)) continue;  // those read their pixel table
    const gl::Buffer modules = module_buffer(display);
    const auto inputs = random_points(2000, {0, 0, 0}, {1024, 768, 0}, 2);
    const auto found = compute(kMapHead,
                               "b[0] = vec4(screen_from_image(modules[0], a.xy), 0.0, 0.0);"
                               "b[1] = vec4(line_direction(modules[0], b[0].xy), 0.0);",
                               inputs, 2, &modules);
    int compared = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const PixelPoint p{inputs[i].x, inputs[i].y};
      const auto line = pixel_line(display, display.modules[0], p);
      if (!line) continue;
      ++compared;
      // Sums of three terms of up to a metre through a homography, divided: a dozen roundings.
      ASSERT_NEAR(found[2 * i].x, line->on_screen.x, 12 * kEpsilon);
      ASSERT_NEAR(found[2 * i].y, line->on_screen.y, 12 * kEpsilon);
      const auto direction = line->on_observer_line - line->on_screen;
      // As many again, on lengths of up to 8 m; and what the screen point was off, times k + 1 < 6.
      ASSERT_NEAR(found[2 * i + 1].x, direction.x, (12 * 8 + 12 * 6) * kEpsilon);
      ASSERT_NEAR(found[2 * i + 1].y, direction.y, 24 * kEpsilon);
      ASSERT_NEAR(found[2 * i + 1].z, direction.z, 4 * kEpsilon);
    }
    EXPECT_GT(compared, 1000);
  }
}

TEST(Twins, Distortion) {
  for (const DisplayCalibration& display : random_displays()) {
    const auto* map = std::get_if<PinholeMap>(&display.modules[0].map);
    if (map == nullptr) continue;
    const gl::Buffer modules = module_buffer(display);
    const auto inputs = random_points(2000, {-0.5, -0.5, 0}, {0.5, 0.5, 0}, 3);
    const auto found = compute(kMapHead, "b[0] = vec4(distort(modules[0], a.xy), 0.0, 0.0);", inputs, 1, &modules);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const glm::dvec2 expected = distort(*map, glm::dvec2(inputs[i].x, inputs[i].y));
      // The result is of the size of its argument, at most 0.5; a dozen roundings.
      ASSERT_LE(glm::length(glm::dvec2(found[i].x, found[i].y) - expected), 12 * 0.5 * kEpsilon);
    }
  }
}

// The pixel tables of pinholes, through the GPU's map back to the pixel's centre.
TEST(Twins, PixelTablesInvertTheMap) {
  for (DisplayCalibration display : random_displays()) {
    if (!std::holds_alternative<PinholeMap>(display.modules[0].map)) continue;
    const auto table = pixel_table(display, display.modules[0]);
    ASSERT_EQ(table.size(), 2U * 1024 * 768);
    std::vector<glm::vec4> inputs;
    std::vector<PixelPoint> centres;
    for (int row = 0; row < 768; row += 37) {
      for (int column = 0; column < 1024; column += 41) {
        const std::size_t at = 2 * (static_cast<std::size_t>(row) * 1024 + column);
        if (std::abs(table[at]) > 1e3F) continue;
        inputs.emplace_back(table[at], table[at + 1], 0, 0);
        centres.push_back(centre_of({column, row}));
      }
    }
    ASSERT_GT(inputs.size(), 300U);
    const gl::Buffer modules = module_buffer(display);
    const auto found = compute(kMapHead, "b[0] = vec4(image_from_screen(modules[0], a.xy), 0.0);", inputs, 1, &modules);
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_EQ(found[i].z, 1);
      // 30 roundings of numbers of the size of the picture, with the lens's shift up to twice its width.
      ASSERT_NEAR(found[i].x, centres[i].x, 30 * 2048 * kEpsilon);
      ASSERT_NEAR(found[i].y, centres[i].y, 30 * 2048 * kEpsilon);
    }
  }
}

// As published: Jarzynski & Olano 2020, listing of pcg3d.
glm::uvec3 pcg3d(glm::uvec3 v) {
  v = v * 1664525U + 1013904223U;
  v.x += v.y * v.z;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v.x ^= v.x >> 16U;
  v.y ^= v.y >> 16U;
  v.z ^= v.z >> 16U;
  v.x += v.y * v.z;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  return v;
}

TEST(Twins, ThePcg3dHashToTheLastBit) {
  std::mt19937 random(4);
  std::vector<glm::vec4> inputs;
  std::vector<glm::uvec3> numbers;
  for (int i = 0; i < 5000; ++i) {
    // Small numbers as pixels have, and any.
    const unsigned shift = i % 2 == 0 ? 20 : 0;
    const auto x = static_cast<unsigned>(random()) >> shift, y = static_cast<unsigned>(random()) >> shift;
    numbers.emplace_back(x, y, static_cast<unsigned>(random()) >> shift);
    const glm::uvec3& n = numbers.back();
    // As two halves each: floats hold 16 bits exactly.
    inputs.emplace_back(static_cast<float>(n.x & 0xffffU), static_cast<float>(n.x >> 16U),
                        static_cast<float>(n.y & 0xffffU), static_cast<float>(n.y >> 16U));
    inputs.emplace_back(static_cast<float>(n.z & 0xffffU), static_cast<float>(n.z >> 16U), 0, 0);
  }
  const auto found =
      compute("#include \"lib/sampling.glsl\"\nlayout(std430, binding = 0) readonly buffer Both { vec4 all[]; };",
              "uvec4 low = uvec4(all[i / 2u * 2u]), high = uvec4(all[i / 2u * 2u + 1u]);"
              "uvec3 h = pcg3d(uvec3(low.x + (low.y << 16u), low.z + (low.w << 16u), high.x + (high.y << 16u)));"
              "b[0] = vec4(h & 0xffffu, 0.0); b[1] = vec4(h >> 16u, 0.0);",
              inputs, 2);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const glm::uvec3 expected = pcg3d(numbers[i]);
    for (int c = 0; c < 3; ++c) {
      const auto low = static_cast<unsigned>(found[4 * i][c]), high = static_cast<unsigned>(found[4 * i + 1][c]);
      ASSERT_EQ(low + (high << 16U), expected[c]) << "number " << i;
    }
  }
}

TEST(Twins, RotationsOfPixelsAreRotationsAndUniform) {
  std::vector<glm::vec4> inputs;
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 200; ++x) inputs.emplace_back(x, y, x % 3, 7);
  }
  const auto found = compute("#include \"lib/sampling.glsl\"",
                             "mat3 m = rotation_of_pixel(uvec2(a.xy), uint(a.z), uint(a.w));"
                             "for (int k = 0; k < 3; ++k) b[k] = vec4(m[k], 0.0);",
                             inputs, 3);
  const double count = static_cast<double>(inputs.size());
  glm::dmat3 mean(0), squares(0);
  double trace = 0;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const glm::dmat3 m{glm::dvec3(found[3 * i]), glm::dvec3(found[3 * i + 1]), glm::dvec3(found[3 * i + 2])};
    const glm::dmat3 unit = glm::transpose(m) * m;
    for (int c = 0; c < 3; ++c) {
      // Sines and cosines of the GPU are good to some 2^-20.
      for (int r = 0; r < 3; ++r) ASSERT_NEAR(unit[c][r], c == r ? 1 : 0, 1e-5);
      mean[c] += m[c] / count;
      squares[c] += m[c] * m[c] / count;
      trace += m[c][c] / count;
    }
    ASSERT_NEAR(glm::determinant(m), 1, 1e-5);
  }
  // Each entry of a uniform rotation is uniform in [-1, 1]: mean 0, variance 1/3, variance of its square 4/45. Five
  // standard errors.
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) {
      EXPECT_NEAR(mean[c][r], 0, 5 * std::sqrt(1 / 3.0 / count));
      EXPECT_NEAR(squares[c][r], 1 / 3.0, 5 * std::sqrt(4 / 45.0 / count));
    }
  }
  EXPECT_NEAR(trace, 0, 5 * std::sqrt(1 / count)) << "1 + 2 cos of the angle: mean 0, variance 1";
}

TEST(Twins, PostCurve) {
  std::vector<glm::vec4> inputs;
  std::vector<AoSettings> settings;
  for (const glm::dvec3& abc :
       {glm::dvec3(0.5, 1, 1), {0.57, 1, 5}, {0, 1.12, 2.5}, {0, 1.03, 4}, {0.5, 1.01, 8}, {-0.2, 0.7, 0.5}}) {
    for (int i = 0; i <= 256; ++i) {
      inputs.emplace_back(i / 256.F, abc.x, abc.y, abc.z);
      AoSettings one;
      one.curve_a = abc.x;
      one.curve_b = abc.y;
      one.curve_c = abc.z;
      settings.push_back(one);
    }
  }
  const auto found = compute("#include \"lib/curve.glsl\"", "b[0] = vec4(post_curve(a.x, a.yzw));", inputs, 1);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    // pow of GLSL has the error of exp2(c log2(x)): some 2^-20 of the result; a root's steepness at 0 makes more of a
    // rounded argument.
    const double tolerance = settings[i].curve_c < 1 ? 1e-3 : 2e-5;
    ASSERT_NEAR(found[i].x, reference::post_curve(inputs[i].x, settings[i]), tolerance)
        << inputs[i].x << ", c " << settings[i].curve_c;
  }
}

// KHR_lights_punctual: range window (1 - (d/r)^4) / d^2, spot attenuation of scale and offset, squared.
TEST(Twins, ArrivingLight) {
  shared::LightParams spot{};
  const glm::dvec3 at(0.2, -0.1, 0.5), axis = glm::normalize(glm::dvec3(0.1, 0.2, -1));
  spot.position_range = glm::vec4(glm::vec3(at), 1.2F);
  spot.direction = glm::vec4(glm::vec3(axis), 0);
  const double inner = std::cos(0.3), outer = std::cos(0.9), scale = 1 / (inner - outer);
  spot.cone = {scale, -outer * scale, 0, 0};
  const std::string head =
      "#include \"shared/light_params.glsl\"\n#include \"lib/lights.glsl\"\n"
      "layout(std430, binding = 2) readonly buffer Lights { LightParams lights[]; };";
  const auto inputs = random_points(4000, {-1, -1, -0.8}, {1, 1, 0.3}, 6);
  for (const float kind : {2.F, 3.F}) {
    spot.color_kind.w = kind;
    const gl::Buffer lights = gl::make_buffer(std::vector{spot});
    const auto found = compute(head, "b[0] = arriving(lights[0], a.xyz);", inputs, 1, &lights);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const glm::dvec3 to = at - glm::dvec3(inputs[i]);
      const double d = glm::length(to);
      double expected = std::clamp(1 - std::pow(d / 1.2, 4), 0.0, 1.0) / (d * d);
      if (kind == 3) expected *= std::pow(std::clamp((glm::dot(-axis, to / d) - outer) * scale, 0.0, 1.0), 2);
      // A dozen roundings, on values of up to 1 / 0.2^2 = 25.
      ASSERT_NEAR(found[i].w, expected, 12 * 25 * kEpsilon);
      // inversesqrt is good to 2 units in the last place by GLSL, to somewhat more where a processor estimates it.
      ASSERT_LE(glm::length(glm::dvec3(found[i]) - to / d), 1e-6);
    }
  }
  spot.color_kind.w = 1;
  const gl::Buffer lights = gl::make_buffer(std::vector{spot});
  for (const auto& one : compute(head, "b[0] = arriving(lights[0], a.xyz);", inputs, 1, &lights)) {
    ASSERT_EQ(one, glm::vec4(-glm::vec3(spot.direction), 1)) << "directional light comes from everywhere alike";
  }
}

}  // namespace
}  // namespace lfd
