// Which frame is shown, which images are refused, and why.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/one_pixel_images.h"

namespace lfd::display {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

const Clock::time_point kStart{};

// An assembly for one node "a" that draws modules 0 and 1 and has all the credit it can get.
struct TwoModules {
  FrameAssembly assembly;
  TwoModules() {
    assembly.configure(2, kOnePixel);
    EXPECT_TRUE(assembly.node_came("a", kStart));
    assembly.credit_for("a");
  }
  Status send(std::uint64_t frame, std::uint32_t module, const std::string& node = "a") {
    const Status status = assembly.image_came(node, image_of(frame, module, 2), pixel_of(frame, module), kStart);
    assembly.credit_for(node);
    return status;
  }
};

TEST(DisplayAssembly, ShowsAFrameOnceItIsWholeAndSwapped) {
  TwoModules display;
  ASSERT_TRUE(display.send(5, 0));
  display.assembly.swapped(5, {});
  EXPECT_FALSE(display.assembly.next_frame(kStart)) << "module 1 is missing";
  ASSERT_TRUE(display.send(5, 1));
  const auto frame = display.assembly.next_frame(kStart);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->frame, 5u);
  EXPECT_EQ(frame->fresh_modules, 2);
  EXPECT_FALSE(display.assembly.next_frame(kStart)) << "shown once";
}

TEST(DisplayAssembly, WaitsForTheSwapButNotForEver) {
  TwoModules display;
  ASSERT_TRUE(display.send(0, 0));
  ASSERT_TRUE(display.send(0, 1));
  EXPECT_FALSE(display.assembly.next_frame(kStart + FrameAssembly::kSwapPatience - 1ms));
  EXPECT_TRUE(display.assembly.next_frame(kStart + FrameAssembly::kSwapPatience));
}

TEST(DisplayAssembly, StaleModulesKeepTheirLastImage) {
  TwoModules display;
  EXPECT_TRUE(display.assembly.node_came("b", kStart));
  display.assembly.credit_for("b");
  const auto one = [&](const std::string& node, std::uint64_t frame, std::uint32_t module) {
    ASSERT_TRUE(display.assembly.image_came(node, image_of(frame, module, 1), pixel_of(frame, module), kStart));
    display.assembly.credit_for(node);
  };
  one("a", 1, 0);
  one("b", 1, 1);
  display.assembly.swapped(1, {});
  ASSERT_TRUE(display.assembly.next_frame(kStart));
  one("a", 2, 0);
  const std::uint32_t stale[] = {1};
  display.assembly.swapped(2, stale);
  const auto frame = display.assembly.next_frame(kStart);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->fresh_modules, 1);
  EXPECT_EQ(frame->modules[0].frame, 2u);
  EXPECT_FALSE(frame->modules[0].stale);
  EXPECT_EQ(frame->modules[1].frame, 1u);
  EXPECT_TRUE(frame->modules[1].stale);
  EXPECT_EQ(frame->modules[1].image[proto::COLOR]->payload.text(), pixel_of(1, 1).text());
}

TEST(DisplayAssembly, UnchangedModulesComeWithoutPayloadAndAreNotStale) {
  TwoModules display;
  ASSERT_TRUE(display.send(1, 0));
  ASSERT_TRUE(display.send(1, 1));
  display.assembly.swapped(1, {});
  ASSERT_TRUE(display.assembly.next_frame(kStart));
  proto::Image same = image_of(2, 0, 2);
  same.set_same_as_frame(1);
  ASSERT_TRUE(display.assembly.image_came("a", same, {}, kStart));
  display.assembly.swapped(2, {});
  EXPECT_FALSE(display.assembly.next_frame(kStart)) << "module 1 has yet to come";
  ASSERT_TRUE(display.send(2, 1));
  const auto frame = display.assembly.next_frame(kStart);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->fresh_modules, 2);
  EXPECT_EQ(frame->modules[0].frame, 2u);
  EXPECT_EQ(frame->modules[0].image[proto::COLOR]->payload.text(), pixel_of(1, 0).text());
  EXPECT_EQ(frame->modules[1].image[proto::COLOR]->payload.text(), pixel_of(2, 1).text());
}

TEST(DisplayAssembly, WhatIsTheSameAsNothingIsRefused) {
  TwoModules display;
  ASSERT_TRUE(display.send(1, 0));
  proto::Image same = image_of(2, 0, 2);
  for (const std::uint64_t frame : {0, 2, 7}) {
    same.set_same_as_frame(frame);
    const Status status = display.assembly.image_came("a", same, {}, kStart);
    ASSERT_FALSE(status);
    EXPECT_THAT(status.error().message(), HasSubstr("is not here"));
    EXPECT_TRUE(display.assembly.has_lost_touch("a"));
  }
  display.assembly.credit_for("a");
  same.set_same_as_frame(1);
  const Status both = display.assembly.image_came("a", same, pixel_of(2, 0), kStart);
  ASSERT_FALSE(both);
  EXPECT_THAT(both.error().message(), HasSubstr("yet has pixels"));
}

TEST(DisplayAssembly, ModulesThatNobodyDrawsAreNotWaitedFor) {
  FrameAssembly assembly;
  const std::uint32_t owned[] = {1};
  assembly.configure(3, kOnePixel, owned);
  EXPECT_TRUE(assembly.node_came("a", kStart));
  ASSERT_EQ(assembly.credit_for("a"), 3u);
  ASSERT_TRUE(assembly.image_came("a", image_of(0, 1, 1), pixel_of(0, 1), kStart));
  assembly.swapped(0, {});
  const auto frame = assembly.next_frame(kStart);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->fresh_modules, 1);
}

TEST(DisplayAssembly, RefusesWhatCannotBeShownAndSaysWhy) {
  TwoModules display;
  const auto refusal = [&](proto::Image image, std::size_t bytes, const std::string& node = "a") {
    const wire::Payload payload(std::make_shared<const std::string>(bytes, 'x'));
    const Status status = display.assembly.image_came(node, image, payload, kStart);
    display.assembly.credit_for("a");
    return status ? std::string() : status.error().message();
  };
  EXPECT_THAT(refusal(image_of(1, 0, 2), 4, "stranger"), HasSubstr("has not said hello"));
  EXPECT_THAT(refusal(image_of(1, 2, 2), 4),
              HasSubstr("image of frame 1, module 2, buffer 0: the display has 2 modules"));
  EXPECT_THAT(refusal(image_of(1, 0, 2), 5), HasSubstr("5 bytes; 4 make its pixels"));
  EXPECT_THAT(refusal(image_of(1, 0, 0), 4), HasSubstr("it is one of 0"));
  proto::Image large = image_of(1, 0, 2);
  large.set_width_px(4000000000u);
  EXPECT_THAT(refusal(large, 4), HasSubstr("the display's modules have 1 x 1"));
  proto::Image odd = image_of(1, 0, 2);
  odd.set_format(proto::RGBA32F);
  EXPECT_THAT(refusal(odd, 16), HasSubstr("format is not that of its buffer"));
  odd.set_buffer(static_cast<proto::BufferKind>(99));
  EXPECT_THAT(refusal(odd, 16), HasSubstr("unknown"));
  proto::Image empty = image_of(1, 0, 2);
  empty.set_empty(true);
  EXPECT_THAT(refusal(empty, 4), HasSubstr("it is empty, yet has pixels"));
  EXPECT_EQ(refusal(image_of(1, 0, 2), 4), "");
  EXPECT_THAT(refusal(image_of(1, 0, 2), 4), HasSubstr("it has come before"));
  EXPECT_EQ(display.assembly.waiting_images(), 1u);
}

TEST(DisplayAssembly, ImagesWithoutCreditAreRefusedSoThatMemoryIsBounded) {
  FrameAssembly assembly;
  assembly.configure(10, kOnePixel);
  EXPECT_TRUE(assembly.node_came("a", kStart));
  assembly.credit_for("a");
  int taken = 0;
  for (std::uint64_t frame = 0; frame < 100; ++frame) {
    for (std::uint32_t module = 0; module < 10; ++module) {
      if (assembly.image_came("a", image_of(frame, module, 10), pixel_of(frame, module), kStart)) ++taken;
      assembly.credit_for("a");
    }
  }
  EXPECT_EQ(taken, 20) << "two frames of ten images";
  EXPECT_EQ(assembly.waiting_images(), 20u);
}

TEST(DisplayAssembly, LargeFramesGetCreditForOneFrameOnly) {
  FrameAssembly assembly;
  const ImageSize size{2048, 2048};  // 64 MiB of RGBA32F: 8 fit into 512 MiB
  assembly.configure(16, size);
  EXPECT_TRUE(assembly.node_came("a", kStart));
  EXPECT_EQ(assembly.credit_for("a"), 8u);
  proto::Image image = image_of(0, 0, 12);
  image.set_width_px(2048);
  image.set_height_px(2048);
  image.set_buffer(proto::POSITION);
  image.set_format(proto::RGBA32F);
  const wire::Payload pixels(std::make_shared<const std::string>(std::size_t{16} * 2048 * 2048, 'x'));
  ASSERT_TRUE(assembly.image_came("a", image, pixels, kStart));
  EXPECT_EQ(assembly.credit_for("a"), 4u) << "12 in all: one waits, 7 were given before";
}

TEST(DisplayAssembly, NodeThatDroppedAnImageCostsThatFrameOnly) {
  TwoModules display;
  ASSERT_TRUE(display.send(1, 0));  // module 1 of frame 1 was dropped on its way
  ASSERT_TRUE(display.send(2, 0));
  ASSERT_TRUE(display.send(2, 1));
  display.assembly.swapped(1, {});
  display.assembly.swapped(2, {});
  const auto frame = display.assembly.next_frame(kStart);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->frame, 2u);
  EXPECT_EQ(display.assembly.dropped_frames(), 1u);
  EXPECT_EQ(display.assembly.waiting_images(), 0u);
}

TEST(DisplayAssembly, ConfigureStartsAnewEvenWithLowerFrameNumbers) {
  TwoModules display;
  ASSERT_TRUE(display.send(100, 0));
  ASSERT_TRUE(display.send(100, 1));
  display.assembly.swapped(100, {});
  ASSERT_TRUE(display.assembly.next_frame(kStart));
  EXPECT_FALSE(display.send(3, 0)) << "frame 100 is past";
  display.assembly.configure(2, kOnePixel);
  EXPECT_TRUE(display.send(3, 0));
}

}  // namespace
}  // namespace lfd::display
