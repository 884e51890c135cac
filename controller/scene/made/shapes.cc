// Rectangles, materials and lights.
#include "controller/scene/made/shapes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace lfd::scene {
namespace {

proto::Light light_of(proto::Light::Kind kind, glm::dvec3 color) {
  proto::Light light;
  light.set_kind(kind);
  for (int channel = 0; channel < 3; ++channel) light.add_color(static_cast<float>(color[channel]));
  return light;
}

}  // namespace

float snapped(double metres) { return static_cast<float>(std::round(metres * 0x1p24) * 0x1p-24); }

glm::vec3 snapped(glm::dvec3 metres) { return {snapped(metres.x), snapped(metres.y), snapped(metres.z)}; }

MeshArrays mesh_of(std::span<const Rectangle> rectangles) {
  MeshArrays arrays;
  for (const Rectangle& rectangle : rectangles) {
    const auto first = static_cast<std::uint32_t>(arrays.position.size());
    const glm::vec3 normal(glm::normalize(glm::cross(rectangle.u, rectangle.v)));
    for (const auto& [s, t] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
      arrays.position.push_back(
          snapped(rectangle.origin + static_cast<double>(s) * rectangle.u + static_cast<double>(t) * rectangle.v));
      arrays.normal.push_back(normal);
      arrays.uv.emplace_back(rectangle.repeat * s, rectangle.repeat * (1 - t));
      arrays.color.push_back(rectangle.color);
    }
    for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) arrays.index.push_back(first + corner);
  }
  const bool all_white = std::ranges::all_of(arrays.color, [](glm::vec4 color) { return color == glm::vec4(1.0F); });
  if (all_white) arrays.color.clear();
  return arrays;
}

proto::Material plain_material(const std::string& name, glm::dvec3 color) {
  proto::Material material;
  material.set_name(name);
  for (int channel = 0; channel < 3; ++channel) material.add_base_color(static_cast<float>(color[channel]));
  material.add_base_color(1.0F);
  return material;
}

proto::Material textured_material(const std::string& name, const std::string& picture, proto::Texture::Wrap wrap) {
  proto::Material material = plain_material(name, glm::dvec3(1.0));
  material.mutable_texture()->set_picture(picture);
  material.mutable_texture()->set_wrap_s(wrap);
  material.mutable_texture()->set_wrap_t(wrap);
  return material;
}

proto::Light ambient_light(glm::dvec3 color) { return light_of(proto::Light::AMBIENT, color); }

proto::Light directional_light(glm::dvec3 color, glm::dvec3 direction) {
  proto::Light light = light_of(proto::Light::DIRECTIONAL, color);
  *light.mutable_direction() = vector_message(glm::normalize(direction));
  return light;
}

proto::Light point_light(glm::dvec3 color, glm::dvec3 position, double range_m) {
  proto::Light light = light_of(proto::Light::POINT, color);
  *light.mutable_position() = vector_message(position);
  light.set_range_m(range_m);
  return light;
}

}  // namespace lfd::scene
