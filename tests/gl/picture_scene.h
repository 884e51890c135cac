// Small pictures with known pixels: a display on which one pixel is one centimetre at z = 0, seen straight.
#pragma once

#include <array>
#include <string>

#include "base/hash.h"
#include "bench/reference/scene_maker.h"
#include "proto/pictures/png.h"
#include "tests/support/rendering.h"

namespace lfd::testing_support {

using Levels = std::array<int, 3>;

// One module in the middle; 64 x 48 pixels on a screen of 0.64 x 0.48 m.
inline DisplayCalibration centimetre_display() {
  DisplayCalibration display;
  display.name = "centimetres";
  display.screen = {0.64, 0.48};
  display.image = {64, 48};
  display.optics = {Diffuser::kLinear, 0, 3.0};
  display.angular_scattering_rad = 0.02;
  display.modules.push_back({{0, 0, -1.8}, IdealMap{}});
  return display;
}

// Where the centre of a pixel lies on the screen, in the world of same_spaces().
inline Point3<World> centre_in_world(PixelIndex i) {
  return {(i.column + 0.5) / 100 - 0.32, 0.24 - (i.row + 0.5) / 100, 0};
}

// A rectangle at height z, counter-clockwise seen from the viewers; uv (0, 0) at the top left. Numbers in metres.
inline MeshArrays rectangle(float left, float bottom, float right, float top, float z = 0) {
  MeshArrays mesh;
  mesh.position = {{left, bottom, z}, {right, bottom, z}, {right, top, z}, {left, top, z}};
  mesh.normal.assign(4, {0, 0, 1});
  mesh.uv = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  mesh.index = {0, 1, 2, 0, 2, 3};
  return mesh;
}

// Larger than the screen.
inline MeshArrays whole_screen(float z = 0) { return rectangle(-1, -1, 1, 1, z); }

// The same, seen from behind: the other winding and the other normal.
inline MeshArrays turned(MeshArrays mesh) {
  for (std::size_t i = 0; i + 2 < mesh.index.size(); i += 3) std::swap(mesh.index[i], mesh.index[i + 1]);
  for (auto& normal : mesh.normal) normal = -normal;
  return mesh;
}

// Adds the picture to the scene's assets; its hash.
inline std::string add_picture(SceneData& data, const Picture8& picture) {
  auto png = encode_png(picture);
  LFD_CHECK(png, png.error().message());
  proto::Picture message;
  message.set_file(*png);
  const auto bytes = std::make_shared<const std::string>(message.SerializeAsString());
  const std::string hash = content_hash(*bytes);
  data.assets[hash] = bytes;
  return hash;
}

inline proto::Light light(proto::Light::Kind kind, std::array<float, 3> color) {
  proto::Light message;
  message.set_kind(kind);
  for (const float part : color) message.add_color(part);
  return message;
}

// One frame of module 0.
class Shot {
 public:
  explicit Shot(FrameResult result) : result_(std::move(result)) {}

  Levels color(PixelIndex i) const {
    const ModuleImage& picture = image(proto::COLOR);
    Levels levels{};
    for (std::size_t c = 0; c < 3; ++c)
      levels[c] = static_cast<std::uint8_t>((*picture.bytes)[4 * number(picture, i) + c]);
    return levels;
  }

  std::array<float, 4> value(proto::BufferKind kind, PixelIndex i) const {
    const ModuleImage& picture = image(kind);
    std::array<float, 4> rgba{};
    std::memcpy(rgba.data(), picture.bytes->data() + 16 * number(picture, i), sizeof(rgba));
    return rgba;
  }

  bool has_surface(PixelIndex i) const { return value(proto::POSITION, i)[3] == 1; }

  const ModuleImage& image(proto::BufferKind kind) const {
    const ModuleImage* found = find_image(result_, 0, kind);
    LFD_CHECK(found != nullptr, "it was asked for");
    return *found;
  }

 private:
  static std::size_t number(const ModuleImage& picture, PixelIndex i) {
    LFD_CHECK(!picture.empty, "an empty image has no pixels");
    return static_cast<std::size_t>(i.row) * picture.size.width + i.column;
  }

  FrameResult result_;
};

// All buffers of the centimetre display.
inline Shot shoot(const SceneData& data, const proto::RenderSettings& settings = {}) {
  Renderer renderer(context(), centimetre_display(), {0});
  const FrameOptions options{.buffers = buffers({proto::POSITION, proto::NORMAL, proto::AO, proto::DEPTH})};
  return Shot(draw_once(renderer, state_of(data, reference::same_spaces(), settings), data.assets, options));
}

// With the planner and without it.
inline std::array<proto::RenderSettings, 2> both_plans() {
  std::array<proto::RenderSettings, 2> settings;
  settings[1].set_planner(proto::RenderSettings::EVERYTHING);
  return settings;
}

}  // namespace lfd::testing_support
