// Between test patterns and the scene: whatever is shown in between, the scene's pictures are those from before.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/gl/pattern_pictures.h"

namespace lfd {
namespace {

using namespace testing_support;

const BufferSet kAllBuffers = buffers({proto::POSITION, proto::NORMAL, proto::AO, proto::DEPTH, proto::BENT_NORMAL});

class PatternSwitch : public testing::Test {
 protected:
  PatternSwitch() { scene_.mutable_background()->set_b(0.5); }

  FrameResult draw(const proto::RenderSettings& settings, bool reuse = true) {
    return draw_pattern(renderer_, settings, {.buffers = kAllBuffers, .reuse = reuse});
  }

  proto::RenderSettings with(proto::TestPattern::Kind kind) const {
    proto::RenderSettings settings = scene_;
    settings.mutable_pattern()->set_kind(kind);
    return settings;
  }

  static bool has_pass(const FrameResult& frame, const std::string& name) {
    return std::ranges::any_of(frame.report.pass(), [&](const auto& pass) { return pass.pass() == name; });
  }

  proto::RenderSettings scene_;
  Renderer renderer_{context(), row_of_modules(3, {32, 24}), {0, 1, 2}};
};

void expect_same(const FrameResult& a, const FrameResult& b) {
  ASSERT_EQ(a.images.size(), b.images.size());
  for (const ModuleImage& image : a.images) {
    const ModuleImage* other = find_image(b, image.module, image.kind);
    ASSERT_TRUE(other != nullptr && image.empty == other->empty);
    EXPECT_TRUE(image.empty || *image.bytes == *other->bytes) << proto::BufferKind_Name(image.kind);
  }
}

TEST_F(PatternSwitch, GivesTheScenesPicturesBackBitForBit) {
  for (const bool reuse : {true, false}) {
    const FrameResult before = draw(scene_, reuse);
    for (const auto kind : {proto::TestPattern::NUMBER, proto::TestPattern::SOLID}) {
      const FrameResult pattern = draw(with(kind), reuse);
      const FrameResult again = draw(with(kind), reuse);
      expect_same(pattern, again);
      EXPECT_FALSE(is_picture(fed_picture(pattern, 1), fed_picture(before, 1)));
      expect_same(draw(scene_, reuse), before);
    }
  }
}

TEST_F(PatternSwitch, IsTheFirstThingShownToo) {
  const FrameResult pattern = draw(with(proto::TestPattern::NUMBER)), scene = draw(scene_);
  Renderer fresh(context(), row_of_modules(3, {32, 24}), {0, 1, 2});
  expect_same(draw_pattern(fresh, scene_, {.buffers = kAllBuffers}), scene);
  expect_same(draw(with(proto::TestPattern::NUMBER)), pattern);
}

TEST_F(PatternSwitch, AGuardBandAndAPlanOfEverythingChangeNothingOfPatterns) {
  const FrameResult plain = draw(with(proto::TestPattern::GRID));
  proto::RenderSettings settings = with(proto::TestPattern::GRID);
  settings.mutable_ao()->set_guard_band_px(16);
  expect_same(draw(settings), plain);
  settings.set_planner(proto::RenderSettings::EVERYTHING);
  expect_same(draw(settings), plain);
  settings.clear_pattern();
  const FrameResult banded = draw(settings);
  draw(with(proto::TestPattern::GRID));
  expect_same(draw(settings), banded);
}

TEST_F(PatternSwitch, BuffersBesideColourAreEmpty) {
  const FrameResult frame = draw(with(proto::TestPattern::SOLID));
  EXPECT_EQ(frame.images.size(), 3U * 6U);
  for (const ModuleImage& image : frame.images)
    EXPECT_EQ(image.empty, image.kind != proto::COLOR) << proto::BufferKind_Name(image.kind);
}

TEST_F(PatternSwitch, OnePassDrawsIt) {
  const auto start = Clock::now();
  const FrameResult frame = draw(with(proto::TestPattern::NUMBER));
  const double frame_ms = milliseconds(Clock::now() - start);
  for (const auto& pass : frame.report.pass()) EXPECT_LE(pass.gpu_ms(), frame_ms) << pass.pass();
  EXPECT_TRUE(has_pass(frame, "pattern"));
  for (const char* pass : {"z_prepass", "gbuffer", "ao", "blur_horizontal", "post"})
    EXPECT_FALSE(has_pass(frame, pass)) << pass;
  EXPECT_TRUE(has_pass(draw(scene_), "gbuffer"));
}

TEST_F(PatternSwitch, NoOcclusionIsTimedOrChosenForIt) {
  proto::RenderSettings settings = with(proto::TestPattern::NUMBER);
  settings.mutable_ao()->set_budget_ms(1000);
  EXPECT_EQ(draw(settings).report.occlusion_choice(), "");
  settings.clear_pattern();
  EXPECT_NE(draw(settings).report.occlusion_choice(), "");
  settings.mutable_pattern()->set_kind(proto::TestPattern::NUMBER);
  EXPECT_EQ(draw(settings).report.occlusion_choice(), "");
}

// What stands behind a pattern moves on without being drawn.
TEST_F(PatternSwitch, AMovingSceneIsDrawnWhereItStandsOnceItIsShownAgain) {
  const SceneData data = scene_behind();
  proto::State moved = state_of(data, reference::same_spaces(), with(proto::TestPattern::NUMBER));
  const FrameOptions options{.buffers = kAllBuffers};
  draw_once(renderer_, moved, data.assets, options);
  moved.mutable_scene()->mutable_instance(0)->set_world_from_mesh(11, 0.1);
  const FrameResult still = draw_once(renderer_, moved, data.assets, options);
  EXPECT_FALSE(has_pass(still, "pattern")) << "the pattern's picture is in hand";
  *moved.mutable_render() = scene_;
  Renderer fresh(context(), row_of_modules(3, {32, 24}), {0, 1, 2});
  expect_same(draw_once(renderer_, moved, data.assets, options), draw_once(fresh, moved, data.assets, options));
}

}  // namespace
}  // namespace lfd
