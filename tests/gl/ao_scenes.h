// Scenes and buffers that several tests of ambient occlusion look at.
#pragma once

#include "bench/reference/scene_maker.h"
#include "tests/gl/ao_stage.h"

namespace lfd::testing_support {

// z = slope . (x, y), far beyond the screen on all sides.
inline SceneData plane(glm::vec2 slope) {
  reference::SceneMaker maker;
  const auto at = [&](float x, float y) { return glm::vec3(x, y, slope.x * x + slope.y * y); };
  maker.add_quad(at(-1.2F, -1), at(1.2F, -1), at(1.2F, 1), at(-1.2F, 1), maker.add_material({}));
  return maker.data();
}

// Pixels all of whose samples have an image.
inline std::vector<AoPixel> inner(const AoStage& stage, const std::vector<AoPixel>& pixels, double radius_m) {
  const auto reach = stage.reach_px({0, 0, 0}, radius_m);
  LFD_CHECK(reach.has_value(), "the screen's centre is seen");
  const ImageSize size = stage.display().image;
  const double u = 1.5 * reach->x + 2, v = 1.5 * reach->y + 2;
  std::vector<AoPixel> inside;
  for (const AoPixel& pixel : pixels) {
    const bool in =
        pixel.at.column > u && pixel.at.column < size.width - u && pixel.at.row > v && pixel.at.row < size.height - v;
    if (in) inside.push_back(pixel);
  }
  return inside;
}

inline SceneData ball_before_floor() {
  reference::SceneMaker maker;
  const auto white = maker.add_material({});
  maker.add_mesh(reference::sphere({0.1F, 0, 0.1F}, 0.25F, 16), white);
  maker.add_quad({-0.6F, -0.3F, 0.4F}, {0.6F, -0.3F, 0.4F}, {0.6F, -0.2F, -0.4F}, {-0.6F, -0.2F, -0.4F}, white);
  proto::Light ambient, sun;
  ambient.set_kind(proto::Light::AMBIENT);
  for (const float part : {0.5F, 0.4F, 0.3F}) ambient.add_color(part);
  sun.set_kind(proto::Light::DIRECTIONAL);
  for (const float part : {0.2F, 0.3F, 0.4F}) sun.add_color(part);
  sun.mutable_direction()->set_z(-1);
  *maker.data().scene.add_light() = ambient;
  *maker.data().scene.add_light() = sun;
  return maker.data();
}

inline AoStage ball_stage() {
  return {ball_before_floor(), reference::same_spaces(), reference::one_module(Diffuser::kLinear, {96, 72})};
}

inline std::vector<float> floats(const FrameResult& result, proto::BufferKind kind) {
  const ModuleImage* image = find_image(result, 0, kind);
  LFD_CHECK(image != nullptr, "it was asked for");
  return floats_of(*image);
}

}  // namespace lfd::testing_support
