// Triangles and lights to the GPU.
#include "rendernode/passes/gpu_scene.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace lfd {
namespace {

glm::dvec3 vector_from(const proto::Vector& v) { return {v.x(), v.y(), v.z()}; }

// Scale and offset of a spot's attenuation, as KHR_lights_punctual recommends.
glm::vec4 cone_of(const proto::Light& light) {
  const double inner = std::cos(light.inner_cone_rad()), outer = std::cos(light.outer_cone_rad());
  const double scale = 1 / std::max(0.001, inner - outer);
  return {scale, -outer * scale, 0, 0};
}

shared::LightParams params_of(const proto::Light& light, const RegionOfInterest& roi) {
  shared::LightParams params{};
  glm::dvec3 direction = vector_from(light.direction());
  float kind = static_cast<float>(light.kind());
  if (light.kind() == proto::Light::HEAD) {
    kind = proto::Light::DIRECTIONAL;
    direction = world_from_physical(roi).linear * glm::dvec3(0, 0, -1);
  }
  if (glm::length(direction) > 0) direction = glm::normalize(direction);
  const glm::dvec3 position = vector_from(light.position()) - to_glm(roi.world_centre);
  for (int i = 0; i < 3; ++i) params.color_kind[i] = i < light.color_size() ? light.color(i) : 1.0F;
  params.color_kind.w = kind;
  params.position_range = glm::vec4(glm::vec3(position), static_cast<float>(light.range_m()));
  params.direction = glm::vec4(glm::vec3(direction), 0);
  params.cone = cone_of(light);
  return params;
}

}  // namespace

std::size_t most_triangles() {
  constexpr std::size_t kTexelsEach = sizeof(shared::PrimitivePlane) / sizeof(glm::vec4);
  return std::min(kMostTriangles, gl::most_texels() / kTexelsEach);
}

GpuGeometry upload_geometry(const PhysicalGeometry& geometry) {
  gl::Buffer planes = gl::make_buffer(geometry.planes);
  gl::Texture texels = gl::make_buffer_texture(GL_RGBA32F, planes);
  return {gl::make_buffer(geometry.vertices), gl::make_buffer(geometry.indices), std::move(planes), std::move(texels)};
}

GpuLights upload_lights(const proto::Scene& scene, const RegionOfInterest& roi) {
  GpuLights gpu;
  std::vector<shared::LightParams> params;
  for (const auto& light : scene.light()) {
    params.push_back(params_of(light, roi));
    gpu.facts.need_normal = gpu.facts.need_normal || light.kind() != proto::Light::AMBIENT;
    gpu.facts.need_position =
        gpu.facts.need_position || light.kind() == proto::Light::POINT || light.kind() == proto::Light::SPOT;
  }
  gpu.params = gl::make_buffer(params);
  gpu.count = static_cast<int>(params.size());
  return gpu;
}

}  // namespace lfd
