// Lighting again.
#include "bench/stability/color_truth.h"

#include <algorithm>
#include <cmath>

#include "base/log.h"
#include "bench/common/frame_picture.h"
#include "proto/pictures/srgb.h"

namespace lfd::bench {
namespace {

// As it is kept between the passes.
glm::dvec3 albedo_of(const proto::Scene& scene) {
  glm::dvec3 albedo(1);
  for (int c = 0; c < 3; ++c) albedo[c] = linear_from_srgb8()[srgb8_from_linear(scene.material(0).base_color(c))];
  return albedo;
}

// What falls on a surface with this normal that is open by this share.
glm::dvec3 light_on(const proto::Scene& scene, glm::dvec3 to_observers, glm::dvec3 normal, double openness) {
  glm::dvec3 sum(0);
  for (const proto::Light& light : scene.light()) {
    const bool is_ambient = light.kind() == proto::Light::AMBIENT;
    LFD_CHECK(is_ambient || light.kind() == proto::Light::HEAD, "lights whose sum is known");
    const double share = is_ambient ? openness : std::max(glm::dot(normal, to_observers), 0.0);
    for (int c = 0; c < 3; ++c) sum[c] += light.color(c) * share;
  }
  return sum;
}

glm::dvec3 drive_of(const DisplayCalibration& display, PixelPoint at, glm::dvec3 light) {
  const auto& color = display.modules[0].color;
  if (color) return drive_for(*color, gain_at(color->gain, display.image, at), light);
  for (int c = 0; c < 3; ++c) light[c] = srgb_from_linear(std::clamp(light[c], 0.0, 1.0));
  return light;
}

}  // namespace

ColorTruth compare_colors(const DisplayCalibration& display, const proto::Scene& scene, const RegionOfInterest& roi,
                          const RenderSettings& settings, const FrameResult& frame) {
  ColorTruth truth;
  const ModuleImage& color = image_of(frame, proto::COLOR);
  if (color.empty) return truth;
  const PictureF position = picture_of(frame, proto::POSITION), normal = picture_of(frame, proto::NORMAL),
                 ao = picture_of(frame, proto::AO);
  const glm::dvec3 albedo = albedo_of(scene);
  const glm::dvec3 to_observers = glm::normalize(world_from_physical(roi).linear * glm::dvec3(0, 0, 1));
  for (int row = 0; row < display.image.height; ++row) {
    for (int column = 0; column < display.image.width; ++column) {
      const std::size_t i = 4 * (static_cast<std::size_t>(row) * display.image.width + column);
      glm::dvec3 light(settings.background);
      const bool is_surface = position.rgba[i + 3] != 0;
      if (is_surface) {
        const glm::dvec3 n(normal.rgba[i], normal.rgba[i + 1], normal.rgba[i + 2]);
        light = albedo;
        if (!settings.unlit) light *= light_on(scene, to_observers, glm::normalize(n), 1 - ao.rgba[i]);
      }
      const glm::dvec3 drive = drive_of(display, centre_of({column, row}), light);
      ++truth.compared;
      truth.surfaces += is_surface;
      for (int c = 0; c < 3; ++c) {
        const int got = static_cast<unsigned char>((*color.bytes)[i + static_cast<std::size_t>(c)]);
        const int expected = static_cast<int>(std::lround(255 * drive[c]));
        if (std::abs(got - expected) <= truth.worst) continue;
        truth.worst = std::abs(got - expected);
        truth.where = fmt::format("pixel {}, {}: channel {} is {}, not {}", column, row, "rgb"[c], got, expected);
      }
    }
  }
  return truth;
}

}  // namespace lfd::bench
