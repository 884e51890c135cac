// The scene, displays and settings with which guard bands are tested.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "calibration/make.h"
#include "tests/gl/ao_scenes.h"

namespace lfd::testing_support::guard_band {

inline constexpr double kRadius = 0.08;
inline constexpr int kBand_px = 16;
inline constexpr proto::BufferKind kAllKinds[] = {proto::COLOR, proto::POSITION, proto::NORMAL, proto::AO,
                                                  proto::DEPTH};

// A wavy wall that reaches beyond every border of the screen, a ball before it, and holes between wall and floor.
inline SceneData scene_beyond_the_borders() {
  reference::SceneMaker maker;
  const auto grey = maker.add_material({.base_color = {0.7F, 0.6F, 0.5F, 1}});
  const auto green = maker.add_material({.base_color = {0.3F, 0.8F, 0.4F, 1}});
  maker.add_mesh(reference::sphere({0.1F, 0, 0.15F}, 0.2F, 24), green);
  for (int i = -12; i < 12; ++i) {
    const auto at = [](int k, float y) { return glm::vec3(0.1F * k, y, k % 2 == 0 ? -0.1F : -0.04F); };
    maker.add_quad(at(i, -0.3F), at(i + 1, -0.3F), at(i + 1, 0.8F), at(i, 0.8F), grey);
  }
  maker.add_quad({-1.3F, -0.35F, 0.4F}, {1.3F, -0.35F, 0.4F}, {1.3F, -0.33F, -0.3F}, {-1.3F, -0.33F, -0.3F}, green);
  proto::Light& ambient = *maker.data().scene.add_light();
  ambient.set_kind(proto::Light::AMBIENT);
  for (const float part : {0.7F, 0.6F, 0.5F}) ambient.add_color(part);
  proto::Light& sun = *maker.data().scene.add_light();
  sun.set_kind(proto::Light::DIRECTIONAL);
  for (const float part : {0.2F, 0.3F, 0.3F}) sun.add_color(part);
  sun.mutable_direction()->set_x(-0.3);
  sun.mutable_direction()->set_z(-1);
  return maker.data();
}

inline proto::RenderSettings settings_of(const std::string& method, int guard_band_px) {
  proto::RenderSettings settings;
  proto::AmbientOcclusion& ao = *settings.mutable_ao();
  ao.set_method(method);
  ao.set_radius_m(kRadius);
  ao.set_guard_band_px(guard_band_px);
  return settings;
}

inline proto::RenderSettings with_band(proto::RenderSettings settings, int px) {
  settings.mutable_ao()->set_guard_band_px(px);
  return settings;
}

// The curve opens everything: colours are those without ambient occlusion, which is drawn all the same.
inline proto::RenderSettings opened(proto::RenderSettings settings) {
  settings.mutable_ao()->mutable_curve()->set_a(1);
  settings.mutable_ao()->mutable_curve()->set_b(1);
  settings.mutable_ao()->mutable_curve()->set_c(1);
  return settings;
}

inline FrameResult drawn(Renderer& renderer, const proto::RenderSettings& settings,
                         const SceneData& data = scene_beyond_the_borders()) {
  const FrameOptions options{.buffers = buffers({proto::POSITION, proto::NORMAL, proto::AO, proto::DEPTH})};
  return draw_once(renderer, state_of(data, reference::same_spaces(), settings), data.assets, options);
}

inline FrameResult drawn(const DisplayCalibration& display, const proto::RenderSettings& settings,
                         const SceneData& data = scene_beyond_the_borders()) {
  Renderer renderer(context(), display, {0});
  return drawn(renderer, settings, data);
}

inline std::vector<float> buffer(const FrameResult& result, proto::BufferKind kind, std::uint32_t module = 0) {
  const ModuleImage* image = find_image(result, module, kind);
  LFD_CHECK(image != nullptr && !image->empty, "it was asked for");
  if (kind != proto::COLOR) return floats_of(*image);
  std::vector<float> levels;
  for (const char byte : *image->bytes) levels.push_back(static_cast<float>(static_cast<std::uint8_t>(byte)) / 255);
  return levels;
}

inline std::size_t seen_pixels(const std::vector<float>& positions) {
  std::size_t seen = 0;
  for (std::size_t i = 3; i < positions.size(); i += 4) seen += positions[i] != 0 ? 1 : 0;
  return seen;
}

inline DisplayCalibration of_image(DisplayCalibration display, ImageSize image) {
  display.image = image;
  return display;
}

inline DisplayCalibration desk(ImageSize image) {
  auto made = make_display("640rc", 3);
  LFD_CHECK(made, made.error().message());
  std::swap(made->modules[0], made->modules[1]);
  return of_image(*made, image);
}

template <class T>
T value(Result<T> result) {
  LFD_CHECK(result, result.error().message());
  return *std::move(result);
}

// Each map is the ideal one, and then this.
inline DisplayCalibration with_homographies(DisplayCalibration display, const glm::dmat3& error) {
  for (auto& module : display.modules)
    module.map = HomographyMap{error * ideal_homography(display.screen, display.image)};
  return display;
}

// The images reach beyond the screen by an eighth of their size on every side.
inline DisplayCalibration overshooting(const DisplayCalibration& display) {
  const double u = 0.125 * display.image.width, v = 0.125 * display.image.height;
  return with_homographies(display, {0.75, 0, 0, 0, 0.75, 0, u, v, 1});
}

}  // namespace lfd::testing_support::guard_band
