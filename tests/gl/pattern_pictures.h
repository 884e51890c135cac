// Pictures of test patterns, pixel by pixel, and pictures that they are expected to be.
#pragma once

#include <numeric>
#include <string>
#include <vector>

#include "tests/gl/picture_scene.h"

namespace lfd::testing_support {

inline constexpr Levels kBlack{0, 0, 0}, kWhite{255, 255, 255}, kRed{255, 0, 0};

// A picture in the bytes that modules are fed, without alpha.
struct FedPicture {
  ImageSize size;
  std::vector<Levels> pixels;  // rows from the top
  bool operator==(const FedPicture&) const = default;

  Levels at(PixelIndex i) const { return pixels[static_cast<std::size_t>(i.row) * size.width + i.column]; }
};

// Every pixel by itself.
template <class ColorAt>
FedPicture picture_of(ImageSize size, ColorAt color_at) {
  FedPicture picture{size, {}};
  for (int row = 0; row < size.height; ++row) {
    for (int column = 0; column < size.width; ++column) picture.pixels.push_back(color_at(PixelIndex{column, row}));
  }
  return picture;
}

inline FedPicture fed_picture(const FrameResult& frame, std::uint32_t module) {
  const ModuleImage* image = find_image(frame, module, proto::COLOR);
  LFD_CHECK(image != nullptr && !image->empty, "every module shows something");
  return picture_of(image->size, [&](PixelIndex i) {
    const std::size_t first = 4 * (static_cast<std::size_t>(i.row) * image->size.width + i.column);
    Levels levels{};
    for (std::size_t c = 0; c < 3; ++c) levels[c] = static_cast<std::uint8_t>((*image->bytes)[first + c]);
    return levels;
  });
}

// Where the first pixel that differs lies; passes where there is none.
inline testing::AssertionResult is_picture(const FedPicture& found, const FedPicture& expected) {
  if (found.size != expected.size) return testing::AssertionFailure() << "of another size";
  for (int row = 0; row < found.size.height; ++row) {
    for (int column = 0; column < found.size.width; ++column) {
      const Levels one = found.at({column, row}), other = expected.at({column, row});
      if (one == other) continue;
      return testing::AssertionFailure() << "pixel " << column << ", " << row << ": " << testing::PrintToString(one)
                                         << " instead of " << testing::PrintToString(other);
    }
  }
  return testing::AssertionSuccess();
}

// So many modules side by side, each with images of this size.
inline DisplayCalibration row_of_modules(int count, ImageSize image) {
  DisplayCalibration display = centimetre_display();
  display.image = image;
  display.modules.clear();
  for (int k = 0; k < count; ++k) display.modules.push_back({{0.01 * k, 0, -1.8}, IdealMap{}});
  return display;
}

inline std::vector<std::uint32_t> all_modules(const DisplayCalibration& display) {
  std::vector<std::uint32_t> modules(display.modules.size());
  std::iota(modules.begin(), modules.end(), 0U);
  return modules;
}

// A lit surface that fills the screen, behind any pattern.
inline SceneData scene_behind() {
  reference::SceneMaker maker;
  maker.add_mesh(whole_screen(), maker.add_material({.base_color = {0.4F, 0.6F, 0.3F, 1}}));
  *maker.data().scene.add_light() = light(proto::Light::AMBIENT, {0.8F, 0.7F, 0.9F});
  return maker.data();
}

// The pattern before a blue background.
inline proto::RenderSettings settings_with(const proto::TestPattern& pattern) {
  proto::RenderSettings settings;
  settings.mutable_background()->set_b(0.5);
  *settings.mutable_pattern() = pattern;
  return settings;
}

inline FrameResult draw_pattern(Renderer& renderer, const proto::RenderSettings& settings, FrameOptions options = {}) {
  const SceneData data = scene_behind();
  return draw_once(renderer, state_of(data, reference::same_spaces(), settings), data.assets, options);
}

// One frame of all modules.
inline FrameResult drawn_pattern(const DisplayCalibration& display, const proto::TestPattern& pattern) {
  Renderer renderer(context(), display, all_modules(display));
  return draw_pattern(renderer, settings_with(pattern));
}

inline proto::TestPattern pattern_of(proto::TestPattern::Kind kind) {
  proto::TestPattern pattern;
  pattern.set_kind(kind);
  return pattern;
}

}  // namespace lfd::testing_support
