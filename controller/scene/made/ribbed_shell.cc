// The demo's scene: a ribbed ammonite of 29520 faces on a stone plinth, in a niche of floor and wall.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "controller/scene/made/noise.h"
#include "controller/scene/made/recipes.h"
#include "controller/scene/made/shapes.h"
#include "controller/scene/made/texture.h"

namespace lfd::scene {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kAlong = 492;  // steps along the spiral
constexpr int kAround = 30;  // steps around the tube
static_assert(2 * kAlong * kAround == 29520);

constexpr double kTurns = 4.6;
constexpr double kGrowth = 2.15;      // of the radius, per turn
constexpr double kTubeRadius = 0.40;  // of the spiral's radius: whorls overlap a little
constexpr double kThickness = 0.80;   // of the tube along the axis, to that across
constexpr double kRibsPerTurn = 17;
constexpr double kRadius = 0.172;  // of the spiral at its mouth, metres
constexpr int kTexels = 512;

// A point of the shell's surface: s in [0, 1] along the spiral, t in [0, 1] around the tube, 0 at the outside.
glm::dvec3 shell_point(double s, double t) {
  const double theta = 2 * kPi * kTurns * (s - 1);
  const double radius = kRadius * std::pow(kGrowth, theta / (2 * kPi));
  const double phi = 2 * kPi * t;
  // Ribs bend forward toward the outside, are strongest there and end before the inner side.
  const double outside = 0.5 + 0.5 * std::cos(phi);
  const double rib = std::cos(kRibsPerTurn * theta + 1.4 * outside);
  const double crest = 0.5 + 0.5 * rib;
  const double relief = 0.13 * std::pow(outside, 0.55) * crest * crest;
  const double flare = 1 + 0.10 * glm::smoothstep(0.965, 1.0, s);  // the lip
  const double tube = radius * kTubeRadius * flare;
  const double across = radius + tube * (1 + relief) * std::cos(phi);
  const double along_axis = kThickness * tube * (1 + 1.6 * relief) * std::sin(phi);
  return {across * std::cos(theta), across * std::sin(theta), along_axis};
}

// Area-weighted; the seam where t passes 1 has the same normal on both sides.
std::vector<glm::vec3> smooth_normals(const MeshArrays& arrays) {
  std::vector<glm::dvec3> sums(arrays.position.size(), glm::dvec3(0.0));
  for (std::size_t i = 0; i < arrays.index.size(); i += 3) {
    const std::array<std::uint32_t, 3> corner = {arrays.index[i], arrays.index[i + 1], arrays.index[i + 2]};
    const glm::dvec3 a(arrays.position[corner[0]]);
    const glm::dvec3 area =
        glm::cross(glm::dvec3(arrays.position[corner[1]]) - a, glm::dvec3(arrays.position[corner[2]]) - a);
    for (const std::uint32_t vertex : corner) sums[vertex] += area;
  }
  for (std::size_t ring = 0; ring <= kAlong; ++ring) {
    glm::dvec3& first = sums[ring * (kAround + 1)];
    glm::dvec3& last = sums[ring * (kAround + 1) + kAround];
    first = last = first + last;
  }
  std::vector<glm::vec3> normals;
  for (const glm::dvec3& sum : sums) normals.push_back(snapped(glm::normalize(sum)));
  return normals;
}

MeshArrays shell_mesh() {
  MeshArrays arrays;
  for (int ring = 0; ring <= kAlong; ++ring) {
    for (int step = 0; step <= kAround; ++step) {
      const double s = static_cast<double>(ring) / kAlong;
      const double t = static_cast<double>(step) / kAround;
      arrays.position.push_back(snapped(shell_point(s, step == kAround ? 0.0 : t)));
      arrays.uv.emplace_back(static_cast<float>(s * kTurns * 1.5), static_cast<float>(t));
    }
  }
  for (std::uint32_t ring = 0; ring < kAlong; ++ring) {
    for (std::uint32_t step = 0; step < kAround; ++step) {
      const std::uint32_t a = ring * (kAround + 1) + step;
      const std::uint32_t b = a + kAround + 1;
      arrays.index.insert(arrays.index.end(), {a, a + 1, b + 1, a, b + 1, b});
    }
  }
  arrays.normal = smooth_normals(arrays);
  return arrays;
}

glm::dvec3 nacre(std::uint64_t seed, double u, double v) {
  const double wander = 0.35 * (tiled_octaves(seed, u, v, 4, 3, 4) - 0.5);
  const double band = 0.5 + 0.5 * std::sin(2 * kPi * (6 * u + wander * 3));
  const double fine = 0.5 + 0.5 * std::sin(2 * kPi * (38 * u + 2 * wander));
  const double outside = 0.5 + 0.5 * std::cos(2 * kPi * v);
  const glm::dvec3 cream(0.96, 0.87, 0.72);
  const glm::dvec3 amber(0.86, 0.63, 0.42);
  const glm::dvec3 russet(0.52, 0.24, 0.13);
  glm::dvec3 color = glm::mix(cream, amber, 0.70 * glm::smoothstep(0.25, 0.9, band));
  const double patches = tiled_octaves(seed + 10, u, v, 5, 4, 4);
  color = glm::mix(color, russet, 0.85 * glm::smoothstep(0.52, 0.72, patches) * (0.35 + 0.65 * outside));
  const double sheen = tiled_octaves(seed + 20, u, v, 3, 6, 3);
  color += 0.04 * glm::dvec3(std::cos(2 * kPi * sheen), std::cos(2 * kPi * (sheen + 0.33)),
                             std::cos(2 * kPi * (sheen + 0.67)));
  return color * (0.90 + 0.10 * fine);
}

glm::dvec3 stone_tiles(std::uint64_t seed, double u, double v) {
  constexpr int kTiles = 4;
  const double row = std::floor(v * kTiles);
  const double shifted = u * kTiles + 0.5 * std::fmod(row, 2.0);
  const auto column = static_cast<std::uint64_t>(std::fmod(std::floor(shifted), kTiles));
  const double du = shifted - std::floor(shifted);
  const double dv = v * kTiles - row;
  const double edge = std::min(std::min(du, 1 - du), std::min(dv, 1 - dv));
  const double joint = 1 - glm::smoothstep(0.012, 0.04, edge + 0.02 * (tiled_noise(seed, u, v, 64, 64) - 0.5));
  const double shade = 0.82 + 0.26 * (random_unit(seed, column, static_cast<std::uint64_t>(row)) - 0.5);
  const double grain = 0.80 + 0.40 * tiled_octaves(seed + 1, u, v, 12, 12, 5);
  const glm::dvec3 stone = glm::dvec3(0.50, 0.52, 0.55) * shade * grain;
  return glm::mix(stone, glm::dvec3(0.20, 0.20, 0.21), 0.8 * joint);
}

glm::dvec3 plaster(std::uint64_t seed, double u, double v) {
  const double broad = tiled_octaves(seed, u, v, 3, 3, 5);
  const double strokes = tiled_octaves(seed + 7, u, v, 6, 48, 3);
  return glm::dvec3(0.34, 0.46, 0.50) * (0.72 + 0.40 * broad + 0.16 * strokes);
}

glm::dvec3 marble(std::uint64_t seed, double u, double v) {
  const double warp = tiled_octaves(seed, u, v, 4, 4, 5);
  const double vein = std::pow(1 - std::abs(std::sin(kPi * (2 * u + 3 * v + 3.2 * warp))), 6.0);
  return glm::mix(glm::dvec3(0.90, 0.88, 0.85), glm::dvec3(0.42, 0.40, 0.42), 0.7 * vein) * (0.88 + 0.16 * warp);
}

// A box with a roof, four sides and no bottom.
MeshArrays box_mesh(glm::dvec3 low, glm::dvec3 high) {
  const glm::dvec3 size = high - low;
  const glm::dvec3 x(size.x, 0, 0);
  const glm::dvec3 y(0, size.y, 0);
  const glm::dvec3 z(0, 0, size.z);
  const std::array<Rectangle, 5> sides = {
      Rectangle{.origin = low + y + z, .u = x, .v = -z}, Rectangle{.origin = low + z, .u = x, .v = y},
      Rectangle{.origin = low + x, .u = -x, .v = y}, Rectangle{.origin = low, .u = z, .v = y},
      Rectangle{.origin = low + x + z, .u = -z, .v = y}};
  return mesh_of(sides);
}

Status add(SceneBuilder& scene, MeshArrays mesh, proto::Material material, const glm::dmat4& world_from_mesh) {
  LFD_TRY(const std::string hash, scene.add_mesh(std::move(mesh)));
  return scene.add_instance(hash, scene.add_material(std::move(material)), world_from_mesh);
}

proto::Material painted(SceneBuilder& scene, const std::string& name, const Painter& painter) {
  return textured_material(name, scene.add_picture(painted_png(kTexels, kTexels, painter)), proto::Texture::REPEAT);
}

}  // namespace

Status make_ribbed_shell(std::uint64_t seed, Extent, SceneBuilder& scene) {
  const auto painter = [seed](glm::dvec3 (*paint)(std::uint64_t, double, double), std::uint64_t salt) {
    return [=](double u, double v) { return paint(1000 * seed + salt, u, v); };
  };
  constexpr glm::dmat4 kHere(1.0);
  const std::array<Rectangle, 1> floor = {
      Rectangle{.origin = {-0.48, 0, 0.22}, .u = {0.96, 0, 0}, .v = {0, 0, -0.44}, .repeat = 2}};
  const std::array<Rectangle, 1> wall = {Rectangle{.origin = {-0.48, 0, -0.22}, .u = {0.96, 0, 0}, .v = {0, 0.54, 0}}};
  LFD_TRY_STATUS(add(scene, mesh_of(floor), painted(scene, "stone floor", painter(stone_tiles, 100)), kHere));
  LFD_TRY_STATUS(add(scene, mesh_of(wall), painted(scene, "plaster", painter(plaster, 200)), kHere));
  LFD_TRY_STATUS(add(scene, box_mesh({-0.17, 0, -0.09}, {0.17, 0.05, 0.09}),
                     painted(scene, "marble", painter(marble, 300)), kHere));

  proto::Material shell = painted(scene, "nacre", painter(nacre, 400));
  shell.set_double_sided(true);  // one looks into the mouth
  glm::dmat4 world_from_shell = glm::translate(glm::dmat4(1.0), {-0.02, 0.2535, 0.0});
  world_from_shell = glm::rotate(world_from_shell, -0.42, {0, 1, 0});
  world_from_shell = glm::rotate(world_from_shell, 0.12, {0, 0, 1});
  LFD_TRY_STATUS(add(scene, shell_mesh(), std::move(shell), world_from_shell));

  scene.add_light(ambient_light({0.34, 0.35, 0.38}));
  scene.add_light(directional_light({0.70, 0.64, 0.55}, {0.62, -0.62, -0.50}));
  scene.add_light(point_light({0.035, 0.026, 0.016}, {0.34, 0.36, 0.26}, 0.0));
  return {};
}

}  // namespace lfd::scene
