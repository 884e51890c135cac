// GPU functions equal their C++ twins: hashes, rotations, curve and lights.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <random>

#include "bench/reference/ao_limit.h"
#include "shaders/shared/glsl_types.h"
#include "tests/gl/compute.h"

namespace lfd {
namespace {

using testing_support::compute;
using testing_support::random_points;

constexpr float kEpsilon = std::numeric_limits<float>::epsilon();

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

// Shoemake 1992, by the quaternion's own matrix.
glm::dmat3 rotation_of_pixel(glm::uvec2 pixel, unsigned module, unsigned seed) {
  const glm::uvec3 h = pcg3d({pixel.x, pixel.y, module + seed * 4096U});
  const glm::dvec3 u = glm::dvec3(h.x >> 8U, h.y >> 8U, h.z >> 8U) / 16777216.0;
  const double a = std::sqrt(1 - u.x), b = std::sqrt(u.x), turn = 2 * M_PI;
  return glm::mat3_cast(glm::dquat(b * std::cos(turn * u.z), a * std::sin(turn * u.y), a * std::cos(turn * u.y),
                                   b * std::sin(turn * u.z)));
}

TEST(Twins, RotationsOfPixels) {
  std::mt19937 random(8);
  std::vector<glm::vec4> inputs;
  for (int i = 0; i < 4000; ++i)
    inputs.emplace_back(random() % 8192, random() % 8192, random() % 1024, random() % 65536);
  const auto found = compute("#include \"lib/sampling.glsl\"",
                             "mat3 m = random_rotation(noise_of_pixel(uvec2(a.xy), uint(a.z), uint(a.w)));"
                             "for (int k = 0; k < 3; ++k) b[k] = vec4(m[k], 0.0);",
                             inputs, 3);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const glm::uvec4 n(inputs[i]);
    const glm::dmat3 expected = rotation_of_pixel({n.x, n.y}, n.z, n.w);
    for (int c = 0; c < 3; ++c) {
      // Sines and cosines of the GPU are good to some 2^-20; each entry has four products of them.
      for (int r = 0; r < 3; ++r) ASSERT_NEAR(found[3 * i + c][r], expected[c][r], 1e-5) << "number " << i;
    }
  }
}

TEST(Twins, RotationsOfPixelsAreRotationsAndUniform) {
  std::vector<glm::vec4> inputs;
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 200; ++x) inputs.emplace_back(x, y, x % 3, 7);
  }
  const auto found = compute("#include \"lib/sampling.glsl\"",
                             "mat3 m = random_rotation(noise_of_pixel(uvec2(a.xy), uint(a.z), uint(a.w)));"
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
      one.curve = {abc.x, abc.y, abc.z};
      settings.push_back(one);
    }
  }
  const auto found = compute("#include \"lib/curve.glsl\"", "b[0] = vec4(post_curve(a.x, a.yzw));", inputs, 1);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    // pow of GLSL has the error of exp2(c log2(x)): some 2^-20 of the result; a root's steepness at 0 makes more of a
    // rounded argument.
    const double tolerance = settings[i].curve.c < 1 ? 1e-3 : 2e-5;
    ASSERT_NEAR(found[i].x, reference::post_curve(inputs[i].x, settings[i]), tolerance)
        << inputs[i].x << ", c " << settings[i].curve.c;
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
