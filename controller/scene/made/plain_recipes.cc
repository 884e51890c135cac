// Made scenes with known answers: rectangles and nothing else.
#include <array>
#include <cmath>
#include <numbers>

#include "base/log.h"
#include "controller/scene/made/noise.h"
#include "controller/scene/made/recipes.h"
#include "controller/scene/made/shapes.h"
#include "controller/scene/made/texture.h"

namespace lfd::scene {
namespace {

constexpr glm::dmat4 kIdentity(1.0);

Status add_rectangles(SceneBuilder& scene, std::span<const Rectangle> rectangles, proto::Material material) {
  LFD_TRY(const std::string mesh, scene.add_mesh(mesh_of(rectangles)));
  return scene.add_instance(mesh, scene.add_material(std::move(material)), kIdentity);
}

// Facing +z, centred at (x, y).
Rectangle upright(double x, double y, double z, double width, double height) {
  return {.origin = {x - width / 2, y - height / 2, z}, .u = {width, 0, 0}, .v = {0, height, 0}};
}

// Waves that cross the picture at most `cycles` times: smooth everywhere, so that resampling it well loses little.
glm::dvec3 waves(std::uint64_t seed, double cycles, double u, double v) {
  constexpr int kWaves = 6;
  glm::dvec3 color(0.5);
  for (std::uint64_t wave = 0; wave < kWaves; ++wave) {
    const double share = static_cast<double>(wave + 1) / kWaves;
    const double angle = 2 * std::numbers::pi * random_unit(seed, wave, 0);
    const double along = std::cos(angle) * u + std::sin(angle) * v;
    for (std::uint64_t channel = 0; channel < 3; ++channel) {
      const double phase = random_unit(seed, wave, 1 + channel);
      color[static_cast<int>(channel)] += 0.07 * std::cos(2 * std::numbers::pi * (cycles * share * along + phase));
    }
  }
  return color;
}

proto::Material wavy_material(SceneBuilder& scene, const std::string& name, std::uint64_t seed, double cycles) {
  constexpr int kSize = 512;  // 40 texels and more a wave
  const std::string picture =
      scene.add_picture(painted_png(kSize, kSize, [&](double u, double v) { return waves(seed, cycles, u, v); }));
  proto::Material material = textured_material(name, picture, proto::Texture::CLAMP_TO_EDGE);
  material.set_unlit(true);
  return material;
}

// Floor, wall behind it, wall at its left: all of them fronts toward the inside of the box.
std::array<Rectangle, 3> corner_of(Extent extent) {
  const double w = extent.width_m;
  const double h = extent.height_m;
  const glm::dvec3 origin(-w / 2, -h / 2, -h / 2);
  return {Rectangle{.origin = origin + glm::dvec3(0, 0, h), .u = {w, 0, 0}, .v = {0, 0, -h}},
          Rectangle{.origin = origin, .u = {w, 0, 0}, .v = {0, h, 0}},
          Rectangle{.origin = origin + glm::dvec3(0, 0, h), .u = {0, 0, -h}, .v = {0, h, 0}}};
}

const proto::Material& white() {
  static const proto::Material material = plain_material("white", glm::dvec3(1.0));
  return material;
}

}  // namespace

Status make_room(std::uint64_t, Extent extent, SceneBuilder& scene) {
  const double w = extent.width_m;
  const double h = extent.height_m;
  const double d = extent.height_m;
  const glm::dvec3 low(-w / 2, -h / 2, -d / 2);
  const std::array<Rectangle, 6> walls = {
      Rectangle{
          .origin = low + glm::dvec3(0, 0, d), .u = {w, 0, 0}, .v = {0, 0, -d}, .color = {0.60F, 0.55F, 0.50F, 1}},
      Rectangle{.origin = low + glm::dvec3(0, h, 0), .u = {w, 0, 0}, .v = {0, 0, d}, .color = {0.90F, 0.90F, 0.90F, 1}},
      Rectangle{.origin = low, .u = {w, 0, 0}, .v = {0, h, 0}, .color = {0.35F, 0.50F, 0.80F, 1}},
      Rectangle{
          .origin = low + glm::dvec3(w, 0, d), .u = {-w, 0, 0}, .v = {0, h, 0}, .color = {0.80F, 0.80F, 0.30F, 1}},
      Rectangle{
          .origin = low + glm::dvec3(0, 0, d), .u = {0, 0, -d}, .v = {0, h, 0}, .color = {0.80F, 0.30F, 0.25F, 1}},
      Rectangle{
          .origin = low + glm::dvec3(w, 0, 0), .u = {0, 0, d}, .v = {0, h, 0}, .color = {0.30F, 0.65F, 0.35F, 1}}};
  return add_rectangles(scene, walls, plain_material("walls", glm::dvec3(1.0)));
}

Status make_quad(std::uint64_t seed, Extent extent, SceneBuilder& scene) {
  const std::array<Rectangle, 1> quad = {upright(0, 0, 0, extent.width_m, extent.height_m)};
  return add_rectangles(scene, quad, wavy_material(scene, "waves", seed, 12));
}

Status make_depth_steps(std::uint64_t seed, Extent extent, SceneBuilder& scene) {
  const double w = extent.width_m;
  const double h = extent.height_m;
  struct Step {
    double x, y, z, width, height;  // in units of the extent's width, height, width, width, height
  };
  // The background is larger than the screen, so that eyes at the side see no edge of it.
  constexpr std::array<Step, 6> kSteps = {Step{0, 0, -0.125, 1.6, 1.6},         Step{-0.30, 0.15, -0.08, 0.24, 0.45},
                                          Step{0.28, -0.18, -0.04, 0.26, 0.40}, Step{-0.02, 0.22, 0.0, 0.22, 0.34},
                                          Step{-0.20, -0.22, 0.05, 0.22, 0.36}, Step{0.20, 0.16, 0.10, 0.20, 0.30}};
  for (std::size_t i = 0; i < kSteps.size(); ++i) {
    const Step& step = kSteps[i];
    const std::array<Rectangle, 1> rectangle = {
        upright(step.x * w, step.y * h, step.z * w, step.width * w, step.height * h)};
    const double cycles = i == 0 ? 12 : 4;
    LFD_TRY_STATUS(add_rectangles(scene, rectangle, wavy_material(scene, fmt::format("step {}", i), seed + i, cycles)));
  }
  return {};
}

Status make_plane(std::uint64_t, Extent extent, SceneBuilder& scene) {
  const std::array<Rectangle, 1> plane = {upright(0, 0, 0, extent.width_m, extent.height_m)};
  return add_rectangles(scene, plane, white());
}

Status make_wall(std::uint64_t, Extent extent, SceneBuilder& scene) {
  const std::array<Rectangle, 3> planes = corner_of(extent);
  return add_rectangles(scene, std::span(planes).first(2), white());
}

Status make_corner(std::uint64_t, Extent extent, SceneBuilder& scene) {
  return add_rectangles(scene, corner_of(extent), white());
}

}  // namespace lfd::scene
