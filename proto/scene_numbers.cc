// Checking numbers.
#include "proto/scene_numbers.h"

#include <cmath>
#include <numbers>

#include "base/log.h"

namespace lfd {
namespace {

constexpr double kMostLight = 1e30;
constexpr double kFarthest_m = 1e15;  // its square is finite in single precision
constexpr double kMostFactor = 1e30;  // of colours and texture transforms

Status check_range(const char* field, double value, double low, double high) {
  if (value >= low && value <= high) return {};
  return Error(fmt::format("{}: {:g}; {:g} to {:g} are possible", field, value, low, high));
}

template <class Numbers>
Status check_all(const char* field, const Numbers& numbers, double low, double high) {
  for (const double number : numbers) LFD_TRY_STATUS(check_range(field, number, low, high));
  return {};
}

Status check_vector(const char* field, const proto::Vector& v, double most) {
  for (const double part : {v.x(), v.y(), v.z()}) LFD_TRY_STATUS(check_range(field, part, -most, most));
  return {};
}

template <class Placed>  // proto::Instance, proto::MovedInstance
Status check_place(const Placed& placed) {
  for (const double number : placed.world_from_mesh()) {
    if (!std::isfinite(number)) return Error(fmt::format("world_from_mesh: {} is not finite", number));
  }
  return {};
}

Status check(const proto::Material& material) {
  LFD_TRY_STATUS(check_all("base_color", material.base_color(), -kMostFactor, kMostFactor));
  if (material.has_alpha_cutoff())
    LFD_TRY_STATUS(check_range("alpha_cutoff", material.alpha_cutoff(), -kMostFactor, kMostFactor));
  return check_all("texture: uv_transform", material.texture().uv_transform(), -kMostFactor, kMostFactor);
}

Status check(const proto::Light& light) {
  if (!proto::Light::Kind_IsValid(light.kind())) return Error(fmt::format("kind: {} is unknown", light.kind()));
  LFD_TRY_STATUS(check_all("color", light.color(), 0, kMostLight));
  LFD_TRY_STATUS(check_vector("position", light.position(), kFarthest_m));
  LFD_TRY_STATUS(check_vector("direction", light.direction(), kFarthest_m));
  const auto& d = light.direction();
  const bool is_aimed = light.kind() == proto::Light::DIRECTIONAL || light.kind() == proto::Light::SPOT;
  if (is_aimed && !(std::hypot(d.x(), d.y(), d.z()) > 1e-15)) return Error("direction: it has none");
  LFD_TRY_STATUS(check_range("range_m", light.range_m(), 0, kFarthest_m));
  const double inner = light.inner_cone_rad(), outer = light.outer_cone_rad();
  LFD_TRY_STATUS(check_range("inner_cone_rad", inner, 0, std::numbers::pi / 2));
  LFD_TRY_STATUS(check_range("outer_cone_rad", outer, 0, std::numbers::pi / 2));
  if (light.kind() != proto::Light::SPOT || inner < outer) return {};
  return Error(fmt::format("inner_cone_rad: {:g} must be less than outer_cone_rad, {:g}", inner, outer));
}

template <class Items, class Check>
Status check_each(const char* name, const Items& items, Check check) {
  for (int i = 0; i < items.size(); ++i) {
    if (const Status status = check(items[i]); !status) return status.error().within(fmt::format("{} {}", name, i));
  }
  return {};
}

}  // namespace

Status check_numbers(const proto::Scene& scene) {
  LFD_TRY_STATUS(check_each("instance", scene.instance(), [](const auto& one) { return check_place(one); }));
  LFD_TRY_STATUS(check_each("material", scene.material(), [](const auto& one) { return check(one); }));
  return check_each("light", scene.light(), [](const auto& one) { return check(one); });
}

Status check_moved_numbers(const proto::Update& update) {
  const auto within = [](const char* name, std::uint32_t index, const Status& status) {
    return status ? status : Status(status.error().within(fmt::format("{} {}", name, index)));
  };
  for (const proto::MovedInstance& moved : update.moved_instance())
    LFD_TRY_STATUS(within("instance", moved.index(), check_place(moved)));
  for (const proto::MovedLight& moved : update.moved_light())
    LFD_TRY_STATUS(within("light", moved.index(), check(moved.light())));
  return {};
}

}  // namespace lfd
