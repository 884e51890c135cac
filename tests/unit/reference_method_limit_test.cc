// Limits of the methods of ambient occlusion against hand integration: open planes, and the foot of a wall.
#include "bench/reference/method_limit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "bench/reference/scene_maker.h"

namespace lfd::reference {
namespace {

constexpr int kSamples = 20000;
constexpr double kRadius = 0.05;

double four_sigma(double share) { return 4 * std::sqrt(share * (1 - share) / kSamples); }

AoSettings settings_of(std::string_view name) {
  proto::RenderSettings message;
  message.mutable_ao()->set_method(std::string(name));
  return read_settings(message)->ao;
}

class MethodLimit : public testing::TestWithParam<Diffuser> {
 protected:
  MethodLimit() { display_.modules[0].emitter.x = -0.9; }

  double limit(const SceneMaker& maker, const Spot& spot, const AoSettings& settings) const {
    const WorldScene scene = scene_of(maker);
    const Intersector intersector(scene);
    return method_limit(intersector, {display_, display_.modules[0], {}}, spot, settings, kRadius,
                        {.samples = kSamples, .directions = 128, .steps = 400});
  }

  DisplayCalibration display_ = one_module(GetParam());
};
INSTANTIATE_TEST_SUITE_P(Diffusers, MethodLimit, testing::Values(Diffuser::kLinear, Diffuser::kConical),
                         [](const auto& parameter) {
                           return parameter.param == Diffuser::kLinear ? "Linear" : "Conical";
                         });

TEST_P(MethodLimit, OfASlantedOpenPlaneIsHalfTheBallOrNothing) {
  SceneMaker maker;
  maker.add_quad({-5, -5, -0.3F}, {5, -5, 0.3F}, {5, 5, 0.5F}, {-5, 5, -0.1F}, maker.add_material({}));
  const glm::dvec3 n = glm::normalize(glm::cross(glm::dvec3(10, 0, 0.6), glm::dvec3(0, 10, 0.2)));
  for (const occlusion::Method* method : occlusion::methods()) {
    const double found = limit(maker, {{0, 0, 0.1}, {n.x, n.y, n.z}}, settings_of(method->name));
    if (method->name == "sphere" || method->name == "crytek") {
      EXPECT_NEAR(found, 0.5, four_sigma(0.5)) << method->name;
    } else if (method->name == "volumetric") {
      EXPECT_NEAR(found, 0.5, 1e-3) << "pairs complement each other, where lines are parallel";
    } else {
      EXPECT_NEAR(found, 0, 1e-9) << method->name;
    }
  }
}

constexpr float kFloor = -0.2F, kWall = -0.3F;

// A weight of the way to the wall, over the half of all directions that run toward it, each alike or by its cosine.
template <class Weight>
double toward_wall(double d, Weight weight) {
  constexpr int kSteps = 800;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double height = std::sqrt((i + 0.5) / kSteps), r = std::sqrt(1 - height * height);  // by the cosine
    for (int j = 0; j < kSteps; ++j) {
      const double toward = r * std::cos(std::numbers::pi * ((j + 0.5) / kSteps - 0.5));
      sum += weight(d / toward) / (2.0 * kSteps * kSteps);
    }
  }
  return sum;
}

// Share of the ball under the floor or behind the wall (tests/unit/reference_ao_limit_test.cc, without an inner
// radius).
double ball_at_foot(double d) {
  constexpr int kSteps = 10000;
  double open = 0;
  for (int i = 0; i < kSteps; ++i) open += 0.25 * (1 + std::min(d / std::cbrt((i + 0.5) / kSteps), 1.0)) / kSteps;
  return 1 - open;
}

TEST_P(MethodLimit, AtTheFootOfAWallMatchesHandIntegration) {
  SceneMaker maker;
  const std::uint32_t material = maker.add_material({});
  maker.add_quad({-4, kFloor, 2}, {4, kFloor, 2}, {4, kFloor, kWall}, {-4, kFloor, kWall}, material);
  maker.add_quad({-4, kFloor, kWall}, {4, kFloor, kWall}, {4, 3, kWall}, {-4, 3, kWall}, material);
  for (const double d : {0.1, 0.3, 0.7}) {  // radii
    const Spot spot{{0, static_cast<double>(kFloor), static_cast<double>(kWall) + d * kRadius}, {0, 1, 0}};
    const auto near = [&](const AoSettings& settings, double expected, double tolerance) {
      EXPECT_NEAR(limit(maker, spot, settings), expected, tolerance) << settings.method->name << ", " << d;
    };
    near(settings_of("crytek"), ball_at_foot(d), four_sigma(0.5));
    // The cap of half the ball: (1 - d)^2 (2 + d) / 4. All of it lies within a radius behind the wall but for grazing
    // lines.
    near(settings_of("starcraft"), (1 - d) * (1 - d) * (2 + d) / 4, four_sigma(0.25) + 0.01);
    AoSettings march = settings_of("march");
    march.parameter("steps") = 64;
    march.parameter("thickness") = 1000;
    // The first step behind the wall is half a step further than the wall.
    near(march, toward_wall(d, [](double way) { return std::max(0.0, 1 - way); }), four_sigma(0.25) + 0.5 / 64);
    AoSettings gtao = settings_of("gtao");
    gtao.parameter("bitmask") = 1;
    gtao.parameter("thickness") = 1000;
    // What stands within the radius hides all below it; 64 slices and 400 steps find its edge to about 1/100.
    near(gtao, toward_wall(d, [](double way) { return way < 1 ? 1.0 : 0.0; }), 0.012);
  }
}

}  // namespace
}  // namespace lfd::reference
