// Lights at known values: every pixel against the formulas of KHR_lights_punctual in double precision.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "bench/reference/texture.h"
#include "tests/gl/picture_scene.h"

namespace lfd {
namespace {

using namespace testing_support;
using reference::SceneMaker;

constexpr float kBase[] = {1, 0.5F, 0.25F};

proto::Vector vector(double x, double y, double z) {
  proto::Vector v;
  v.set_x(x);
  v.set_y(y);
  v.set_z(z);
  return v;
}

// Light of unit colour that the upright plane z = 0 sends back from p.
template <class Arriving>
void expect_light(const proto::Light& lamp, Arriving arriving) {
  SceneMaker maker;
  maker.add_mesh(whole_screen(), maker.add_material({.base_color = {kBase[0], kBase[1], kBase[2], 1}}));
  *maker.data().scene.add_light() = lamp;
  proto::RenderSettings settings;
  settings.mutable_ao()->set_enabled(false);
  const Shot shot = shoot(maker.data(), settings);
  for (int row = 0; row < 48; row += 3) {
    for (int column = 0; column < 64; column += 3) {
      const double share = arriving(to_glm(centre_in_world({column, row})));
      const Levels found = shot.color({column, row});
      for (int c = 0; c < 3; ++c) {
        // The base colour is kept in 8 bits (half a level), and so is the result.
        const double linear = std::min(1.0, share * lamp.color(c) * static_cast<double>(kBase[c]));
        ASSERT_NEAR(found[static_cast<std::size_t>(c)], 255 * reference::srgb_from_linear(linear), 1.1)
            << column << " " << row << ", channel " << c;
      }
    }
  }
}

TEST(Lights, AmbientIsAFactorOfTheAlbedo) {
  expect_light(light(proto::Light::AMBIENT, {0.7F, 0.8F, 0.9F}), [](glm::dvec3) { return 1.0; });
}

TEST(Lights, DirectionalFallsWithTheCosine) {
  auto lamp = light(proto::Light::DIRECTIONAL, {0.7F, 0.8F, 0.9F});
  *lamp.mutable_direction() = vector(0.6, 0, -0.8);
  expect_light(lamp, [](glm::dvec3) { return 0.8; });
  *lamp.mutable_direction() = vector(0.6, 0, 0.8);
  expect_light(lamp, [](glm::dvec3) { return 0.0; });
}

TEST(Lights, HeadShinesFromTheObservers) {
  expect_light(light(proto::Light::HEAD, {0.7F, 0.8F, 0.9F}), [](glm::dvec3) { return 1.0; });
}

TEST(Lights, PointFallsWithTheSquareOfTheDistanceUpToItsRange) {
  for (const double range : {0.0, 0.35}) {
    auto lamp = light(proto::Light::POINT, {0.05F, 0.04F, 0.03F});
    const glm::dvec3 at(0.1, -0.05, 0.25);
    *lamp.mutable_position() = vector(at.x, at.y, at.z);
    lamp.set_range_m(range);
    expect_light(lamp, [&](glm::dvec3 p) {
      const glm::dvec3 to = at - p;
      const double d = glm::length(to), cosine = to.z / d;
      const double window = range > 0 ? std::clamp(1 - std::pow(d / range, 4), 0.0, 1.0) : 1;
      return cosine * window / (d * d);
    });
  }
}

TEST(Lights, SpotFadesBetweenItsCones) {
  auto lamp = light(proto::Light::SPOT, {0.05F, 0.04F, 0.03F});
  const glm::dvec3 at(0.1, -0.05, 0.25), axis = glm::normalize(glm::dvec3(-0.3, 0.1, -1));
  *lamp.mutable_position() = vector(at.x, at.y, at.z);
  *lamp.mutable_direction() = vector(axis.x, axis.y, axis.z);
  lamp.set_inner_cone_rad(0.2);
  lamp.set_outer_cone_rad(0.6);
  expect_light(lamp, [&](glm::dvec3 p) {
    const glm::dvec3 to = at - p;
    const double d = glm::length(to), cosine = to.z / d;
    const double cone = std::clamp(
        (glm::dot(-axis, to / d) - std::cos(0.6)) / std::max(0.001, std::cos(0.2) - std::cos(0.6)), 0.0, 1.0);
    return cosine * cone * cone / (d * d);
  });
}

TEST(Lights, AddUpAndSaturate) {
  SceneMaker maker;
  maker.add_mesh(whole_screen(), maker.add_material({}));
  *maker.data().scene.add_light() = light(proto::Light::AMBIENT, {0.2F, 0.6F, 0});
  *maker.data().scene.add_light() = light(proto::Light::HEAD, {0.3F, 0.6F, 0});
  proto::RenderSettings settings;
  settings.mutable_ao()->set_enabled(false);
  const Levels found = shoot(maker.data(), settings).color({30, 20});
  EXPECT_NEAR(found[0], 255 * reference::srgb_from_linear(0.5), 1);
  EXPECT_EQ(found[1], 255);
  EXPECT_EQ(found[2], 0);
}

// The light keeps its place in the world however the region of interest is turned and moved.
TEST(Lights, StayWhereTheyAreWhenTheRegionOfInterestMoves) {
  SceneMaker maker;
  maker.add_mesh(whole_screen(), maker.add_material({}),
                 {0, 0, 1, 7, 0, 1, 0, -3, -1, 0, 0, 5});  // faces world +x at (7, -3, 5)
  auto lamp = light(proto::Light::POINT, {0.05F, 0.05F, 0.05F});
  *lamp.mutable_position() = vector(7.25, -3, 5);
  *maker.data().scene.add_light() = lamp;
  RegionOfInterest roi;
  roi.world_centre = {7, -3, 5};
  roi.world_orientation = glm::angleAxis(M_PI / 2, glm::dvec3(0, 1, 0));
  proto::RenderSettings settings;
  settings.mutable_ao()->set_enabled(false);
  Renderer renderer(context(), centimetre_display(), {0});
  const Shot shot(draw_once(renderer, state_of(maker.data(), roi, settings), maker.data().assets, {}));
  const glm::dvec3 p = to_glm(centre_in_world({10, 40})), to = glm::dvec3(0, 0, 0.25) - p;
  const double d = glm::length(to);
  EXPECT_NEAR(shot.color({10, 40})[0], 255 * reference::srgb_from_linear(0.05 * to.z / (d * d * d)), 1.1);
}

}  // namespace
}  // namespace lfd
