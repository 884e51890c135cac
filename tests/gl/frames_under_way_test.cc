// Two frames under way at once, and how many submissions a frame takes.
#include <gtest/gtest.h>

#include "calibration/make.h"
#include "controller/scene/made/made_scenes.h"
#include "rendernode/passes/command_list.h"
#include "tests/support/made.h"
#include "tests/support/rendering.h"

namespace lfd {
namespace {

using testing_support::buffers;
using testing_support::context;
using testing_support::draw_once;
using testing_support::find_image;
using testing_support::state_of;

DisplayCalibration small_display() {
  auto made = make_display("desk", 2);
  LFD_CHECK(made, made.error().message());
  made->image = {64, 48};
  return *made;
}

// A made scene, whole or at half its size: two states with different pictures.
struct TwoStates {
  DisplayCalibration display = small_display();
  Assets assets;
  proto::State whole, half;

  TwoStates() {
    const SceneData data = testing_support::made_data("room");
    assets = data.assets;
    RegionOfInterest roi = testing_support::whole_scene(data.scene, display);
    whole = state_of(data, roi);
    roi.physical_size *= 0.5;
    half = state_of(data, roi);
  }
};

const FrameOptions kAll{.buffers = buffers({proto::POSITION, proto::AO})};

void expect_same(const FrameResult& a, const FrameResult& b) {
  ASSERT_EQ(a.images.size(), b.images.size());
  for (const ModuleImage& image : a.images) {
    const ModuleImage* other = find_image(b, image.module, image.kind);
    ASSERT_NE(other, nullptr);
    EXPECT_TRUE(*image.bytes == *other->bytes)
        << "module " << image.module << ", " << proto::BufferKind_Name(image.kind);
  }
}

TEST(FramesUnderWay, KeepTheirOwnStateAndImages) {
  const TwoStates states;
  Renderer apart(context(), states.display, {0, 1});
  const FrameResult whole = draw_once(apart, states.whole, states.assets, kAll);
  const FrameResult half = draw_once(apart, states.half, states.assets, kAll);
  ASSERT_FALSE(*whole.images[0].bytes == *half.images[0].bytes) << "the two states must look different";

  Renderer together(context(), states.display, {0, 1});
  ASSERT_TRUE(together.set_state(states.whole, states.assets));
  ASSERT_TRUE(together.draw(kAll));
  ASSERT_TRUE(together.set_state(states.half, states.assets));
  ASSERT_TRUE(together.draw(kAll));
  EXPECT_EQ(together.under_way(), 2);
  expect_same(whole, together.collect());
  expect_same(half, together.collect());
}

TEST(FramesUnderWay, RepeatTheFrameBeforeEvenWhileItIsUnderWay) {
  const TwoStates states;
  Renderer renderer(context(), states.display, {0, 1});
  ASSERT_TRUE(renderer.set_state(states.whole, states.assets));
  ASSERT_TRUE(renderer.draw(kAll));
  ASSERT_TRUE(renderer.draw(kAll));
  const FrameResult first = renderer.collect(), second = renderer.collect();
  expect_same(first, second);
  EXPECT_TRUE(std::ranges::any_of(second.report.left_out(), [](const auto& left) {
    return left.why() == "inputs unchanged since the last frame";
  }));
}

// Modules become layers of one draw, never draws of their own.
TEST(Submissions, DoNotGrowWithTheNumberOfModules) {
  const auto submissions = [](int count) {
    auto display = make_display("640rc", count);
    LFD_CHECK(display, display.error().message());
    std::vector<std::uint32_t> modules;
    for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(count); ++k) modules.push_back(k);
    GeometryItem item;
    item.index_count = 3;
    item.low = {-0.1, -0.1, -0.1};
    item.high = {0.1, 0.1, 0.1};
    const std::vector<GeometryItem> items(5, item);
    const std::vector<MaterialFacts> materials(1);
    const FramePlan plan = plan_frame({&*display, &modules, &items, &materials, {}, {}, {}});
    EXPECT_EQ(plan.active_layers.size(), static_cast<std::size_t>(count));
    const CommandList commands = make_commands(plan, items, materials, false);
    std::size_t made = 0;
    for (const Batch& batch : commands.batches) made += batch.submissions.size();
    return std::pair(commands.batches.size(), made);
  };
  EXPECT_EQ(submissions(1), submissions(64));
}

}  // namespace
}  // namespace lfd
