// Small scenes and displays, made by hand, for whatever is judged by the reference.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "base/hash.h"
#include "bench/reference/caster.h"
#include "proto/mesh_arrays.h"

namespace lfd::reference {

using Corners = std::array<glm::vec3, 3>;

struct MaterialFacts {
  bool double_sided = false;
  std::optional<float> alpha_cutoff = std::nullopt;
  std::array<float, 4> base_color{1, 1, 1, 1};
};

// A scene under construction: triangles in the order in which they are added.
class SceneMaker {
 public:
  std::uint32_t add_material(const MaterialFacts& facts) {
    proto::Material& material = *data_.scene.add_material();
    for (const float part : facts.base_color) material.add_base_color(part);
    material.set_double_sided(facts.double_sided);
    if (facts.alpha_cutoff) material.set_alpha_cutoff(*facts.alpha_cutoff);
    return static_cast<std::uint32_t>(data_.scene.material_size() - 1);
  }

  void add_mesh(const MeshArrays& mesh, std::uint32_t material,
                const std::array<double, 12>& world_from_mesh = kUnmoved) {
    const auto bytes = std::make_shared<const std::string>(mesh_message(mesh).SerializeAsString());
    const std::string hash = content_hash(*bytes);
    data_.assets[hash] = bytes;
    proto::Instance& instance = *data_.scene.add_instance();
    instance.set_mesh(hash);
    instance.set_material(material);
    for (const double number : world_from_mesh) instance.add_world_from_mesh(number);
  }

  void add_triangles(const std::vector<Corners>& triangles, std::uint32_t material) {
    add_mesh(mesh_of(triangles), material);
  }

  // A quad a b c d, counter-clockwise seen from its front, as two triangles; uv (0, 0) (1, 0) (1, 1) (0, 1).
  void add_quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, std::uint32_t material) {
    MeshArrays mesh;
    mesh.position = {a, b, c, d};
    mesh.normal.assign(4, glm::normalize(glm::cross(b - a, d - a)));
    mesh.uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.index = {0, 1, 2, 0, 2, 3};
    add_mesh(mesh, material);
  }

  SceneData& data() { return data_; }
  const SceneData& data() const { return data_; }

  static MeshArrays mesh_of(const std::vector<Corners>& triangles) {
    MeshArrays mesh;
    for (const Corners& p : triangles) {
      for (const glm::vec3& corner : p) {
        mesh.index.push_back(static_cast<std::uint32_t>(mesh.position.size()));
        mesh.position.push_back(corner);
        mesh.normal.push_back(glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0])));
      }
    }
    return mesh;
  }

  static constexpr std::array<double, 12> kUnmoved{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

 private:
  SceneData data_;
};

// World and physical space are the same.
inline RegionOfInterest same_spaces() { return {}; }

inline WorldScene scene_of(const SceneMaker& maker, const RegionOfInterest& roi = same_spaces()) {
  auto scene = world_scene(maker.data(), roi);
  LFD_CHECK(scene, scene.error().message());
  return *std::move(scene);
}

// A display of one module: screen 1.6 x 0.9 m, vz 3, emitter to the left and low, so that the two diffusers differ.
inline DisplayCalibration one_module(Diffuser diffuser, ImageSize image = {64, 48}) {
  DisplayCalibration display;
  display.name = "one module";
  display.screen = {1.6, 0.9};
  display.image = image;
  display.optics = {diffuser, 0.1, 3.0};
  display.angular_scattering_rad = 0.02;
  display.modules.push_back({{-0.3, -0.4, -1.8}, IdealMap{}});
  return display;
}

// A sphere of latitudes and longitudes, seen from outside.
inline MeshArrays sphere(glm::vec3 centre, float radius, int rings) {
  MeshArrays mesh;
  const int around = 2 * rings;
  for (int i = 0; i <= rings; ++i) {
    for (int j = 0; j < around; ++j) {
      const double theta = M_PI * i / rings, phi = 2 * M_PI * j / around;
      const glm::vec3 n(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
      mesh.position.push_back(centre + radius * n);
      mesh.normal.push_back(n);
    }
  }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i * around + j % around); };
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < around; ++j) {
      if (i > 0) mesh.index.insert(mesh.index.end(), {at(i, j), at(i, j + 1), at(i + 1, j)});
      if (i + 1 < rings) mesh.index.insert(mesh.index.end(), {at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
    }
  }
  return mesh;
}

}  // namespace lfd::reference
