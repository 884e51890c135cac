// Lights of KHR_lights_punctual.
#include "controller/scene/gltf/lights.h"

#include <cmath>
#include <numbers>

#include "base/log.h"
#include "controller/scene/gltf/document.h"

namespace lfd::scene::gltf {
namespace {

Result<proto::Light> read_light(const tinygltf::Light& from) {
  proto::Light light;
  if (from.type == "directional") {
    light.set_kind(proto::Light::DIRECTIONAL);
  } else if (from.type == "point") {
    light.set_kind(proto::Light::POINT);
  } else if (from.type == "spot") {
    light.set_kind(proto::Light::SPOT);
    const double inner = from.spot.innerConeAngle;
    const double outer = from.spot.outerConeAngle;
    if (!(0 <= inner && inner < outer && outer <= std::numbers::pi / 2)) {
      return Error(fmt::format("spot: cone angles {} and {}: 0 <= inner < outer <= pi/2 is needed", inner, outer));
    }
    light.set_inner_cone_rad(inner);
    light.set_outer_cone_rad(outer);
  } else {
    return Error(fmt::format("type: \"{}\" is none of directional, point, spot", from.type.substr(0, 40)));
  }
  if (!(from.intensity >= 0) || !(from.range >= 0)) return Error("intensity and range must be >= 0");
  if (!from.color.empty() && from.color.size() != 3) return Error("color: 3 numbers are needed");
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const double color = from.color.empty() ? 1.0 : from.color[channel];
    light.add_color(static_cast<float>(color * from.intensity / std::numbers::pi));
  }
  light.set_range_m(from.range);
  return light;
}

}  // namespace

Result<std::optional<proto::Light>> light_of(const tinygltf::Model& model, const tinygltf::Node& node) {
  const auto extension = node.extensions.find("KHR_lights_punctual");
  if (extension == node.extensions.end()) return std::optional<proto::Light>();
  if (!extension->second.IsObject() || !extension->second.Get("light").IsInt()) {
    return Error("KHR_lights_punctual: light: an integer is needed");
  }
  const int index = extension->second.Get("light").GetNumberAsInt();
  LFD_TRY(const tinygltf::Light* from, item_at(model.lights, index, "light"));
  Result<proto::Light> light = read_light(*from);
  if (!light) return light.error().within(label("light", static_cast<std::size_t>(index), from->name));
  return std::optional<proto::Light>(*std::move(light));
}

}  // namespace lfd::scene::gltf
