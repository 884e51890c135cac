// Rectangles, materials and lights that made scenes are put together from.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <string>

#include "controller/scene/scene_builder.h"
#include "proto/mesh_arrays.h"

namespace lfd::scene {

// The parallelogram origin + s u + t v; its front is where u x v points. uv: s to the right, t up (so v of uv is 1 -
// t), times `repeat`.
struct Rectangle {
  glm::dvec3 origin;
  glm::dvec3 u;
  glm::dvec3 v;
  double repeat = 1;
  glm::vec4 color{1.0F};
};

// Two triangles a rectangle. Colours are left out where all are white.
MeshArrays mesh_of(std::span<const Rectangle> rectangles);

// A coordinate rounded to 2^-24 m, so that the last bits of a platform's sine make no difference.
float snapped(double metres);
glm::vec3 snapped(glm::dvec3 metres);

proto::Material plain_material(const std::string& name, glm::dvec3 color);

// White, times the picture that was added under the hash.
proto::Material textured_material(const std::string& name, const std::string& picture, proto::Texture::Wrap wrap);

proto::Light ambient_light(glm::dvec3 color);
proto::Light directional_light(glm::dvec3 color, glm::dvec3 direction);
proto::Light point_light(glm::dvec3 color, glm::dvec3 position, double range_m);

}  // namespace lfd::scene
