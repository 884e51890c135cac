// Numbers of scenes: sound ones pass, others are refused with their place.
#include "proto/scene_numbers.h"

#include <gmock/gmock.h>

#include <functional>
#include <limits>

namespace lfd {
namespace {

using testing::HasSubstr;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

proto::Scene sound_scene() {
  proto::Scene scene;
  auto& instance = *scene.add_instance();
  for (const double number : {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}) instance.add_world_from_mesh(number);
  for (const float part : {1.0F, 0.5F, 0.2F, 1.0F}) scene.add_material()->add_base_color(part);
  auto& light = *scene.add_light();
  light.set_kind(proto::Light::SPOT);
  for (int channel = 0; channel < 3; ++channel) light.add_color(1);
  light.mutable_direction()->set_z(-1);
  light.set_outer_cone_rad(0.5);
  return scene;
}

TEST(SceneNumbers, PassWhereTheyAreSound) {
  EXPECT_TRUE(check_numbers(sound_scene()));
  EXPECT_TRUE(check_numbers(proto::Scene()));
}

TEST(SceneNumbers, AreRefusedWithTheirPlace) {
  const std::pair<const char*, std::function<void(proto::Scene&)>> spoilt[] = {
      {"instance 0: world_from_mesh: nan", [](auto& s) { s.mutable_instance(0)->set_world_from_mesh(7, kNaN); }},
      {"material 1: base_color: inf", [](auto& s) { s.mutable_material(1)->set_base_color(0, kInfinity); }},
      {"material 3: alpha_cutoff: nan", [](auto& s) { s.mutable_material(3)->set_alpha_cutoff(kNaN); }},
      {"light 0: color: -1", [](auto& s) { s.mutable_light(0)->set_color(2, -1); }},
      {"light 0: position: 1e+16", [](auto& s) { s.mutable_light(0)->mutable_position()->set_x(1e16); }},
      {"light 0: direction: it has none", [](auto& s) { s.mutable_light(0)->clear_direction(); }},
      {"light 0: range_m: -1", [](auto& s) { s.mutable_light(0)->set_range_m(-1); }},
      {"light 0: outer_cone_rad: 2", [](auto& s) { s.mutable_light(0)->set_outer_cone_rad(2); }},
      {"light 0: inner_cone_rad: 0.5 must be less", [](auto& s) { s.mutable_light(0)->set_inner_cone_rad(0.5); }},
      {"light 0: kind: 77", [](auto& s) { s.mutable_light(0)->set_kind(static_cast<proto::Light::Kind>(77)); }},
  };
  for (const auto& [message, spoil] : spoilt) {
    proto::Scene scene = sound_scene();
    spoil(scene);
    const Status status = check_numbers(scene);
    ASSERT_FALSE(status) << message;
    EXPECT_THAT(status.error().message(), HasSubstr(message));
  }
}

}  // namespace
}  // namespace lfd
