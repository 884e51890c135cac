// Rendering in tests: one context a process, a state from a scene, one frame of images.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "bench/common/frame_picture.h"
#include "proto/scene_data.h"
#include "rendernode/renderer.h"

namespace lfd::testing_support {

// The context of this test process; made on first use.
inline gl::Context& context() {
  static const std::unique_ptr<gl::Context> kContext = [] {
    auto made = gl::Context::create(-1);
    LFD_CHECK(made, "tests of the gl ring need EGL and OpenGL 4.5: " + made.error().message());
    return std::move(*made);
  }();
  return *kContext;
}

inline proto::State state_of(const SceneData& data, const RegionOfInterest& roi,
                             const proto::RenderSettings& render = {}) {
  proto::State state;
  state.set_sequence(1);
  *state.mutable_scene() = data.scene;
  *state.mutable_roi() = write_roi(roi);
  *state.mutable_render() = render;
  return state;
}

inline BufferSet buffers(std::initializer_list<proto::BufferKind> kinds) {
  BufferSet set;
  for (const auto kind : kinds) set.bits |= 1U << kind;
  return set;
}

// One frame drawn and collected; fails the test where the renderer reports an error.
inline FrameResult draw_once(Renderer& renderer, const proto::State& state, const Assets& assets,
                             FrameOptions options) {
  const Status status = renderer.set_state(state, assets);
  EXPECT_TRUE(status) << (status ? "" : status.error().message());
  if (!status) return {};
  const Status drawn = renderer.draw(options);
  EXPECT_TRUE(drawn) << (drawn ? "" : drawn.error().message());
  if (!drawn) return {};
  return renderer.collect();
}

inline const ModuleImage* find_image(const FrameResult& result, std::uint32_t module, proto::BufferKind kind) {
  for (const auto& image : result.images) {
    if (image.module == module && image.kind == kind) return &image;
  }
  return nullptr;
}

// The pixels of a float buffer, RGBA; all zero for an empty image.
inline std::vector<float> floats_of(const ModuleImage& image) { return bench::picture_of(image).rgba; }

}  // namespace lfd::testing_support
