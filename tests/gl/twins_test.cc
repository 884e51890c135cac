// GPU functions equal their C++ twins: optics and maps.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>

#include "calibration/make.h"
#include "rendernode/passes/gpu_modules.h"
#include "tests/gl/compute.h"

namespace lfd {
namespace {

using testing_support::compute;
using testing_support::random_points;

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

// From angles that nearly planar screens have to a right angle.
TEST(Twins, SeriesOfAngles) {
  std::vector<glm::vec4> inputs;
  for (double angle = 1e-12; angle < 1.57; angle = std::min(1.1 * angle, angle + 0.01))
    inputs.emplace_back(static_cast<float>(angle), static_cast<float>(std::tan(angle)), 0, 0);
  const auto found = compute("#include \"lib/series.glsl\"",
                             "b[0] = vec4(sine_over_and_cosine(a.x), atan_over(a.y), 0.0);", inputs, 1);
  ASSERT_EQ(found.size(), inputs.size());
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const double a = inputs[i].x, t = inputs[i].y;
    // A few roundings of numbers of size 1; the cosine is a difference of such.
    ASSERT_NEAR(found[i].x / (std::sin(a) / a), 1, 4 * kEpsilon) << a;
    ASSERT_NEAR(found[i].y, std::cos(a), 4 * kEpsilon) << a;
    ASSERT_NEAR(found[i].z / (std::atan(t) / t), 1, 8 * kEpsilon) << t;
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

}  // namespace
}  // namespace lfd
