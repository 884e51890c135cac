// Frames whose modules go from node to node, and nodes that come, leave and return.
#include <gtest/gtest.h>

#include <chrono>

#include "tests/unit/one_pixel_images.h"

namespace lfd::display {
namespace {

using namespace std::chrono_literals;

const Clock::time_point kStart{};

// Two nodes, each with one module; "c" is their spare.
struct Shared {
  FrameAssembly assembly;
  Shared() {
    assembly.configure(2, kOnePixel);
    for (const char* node : {"a", "b", "c"}) come(node);
  }
  void come(const std::string& node, Clock::time_point now = kStart) {
    EXPECT_TRUE(assembly.node_came(node, now));
    assembly.credit_for(node);
  }
  void send(const std::string& node, std::uint64_t frame, std::uint32_t module) {
    EXPECT_TRUE(assembly.image_came(node, image_of(frame, module, 1), pixel_of(frame, module + 10 * node[0]), kStart));
    assembly.credit_for(node);
  }
};

TEST(DisplayAssembly, AModuleComesFromTheNodeThatTheSwapNames) {
  Shared display;
  display.send("a", 1, 0);
  display.send("b", 1, 1);
  display.send("c", 1, 1);  // it took the module over
  display.assembly.swapped(1, {}, {{0, "a"}, {1, "c"}});
  const auto frame = display.assembly.next_frame(kStart);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->modules[1].image[proto::COLOR]->payload.text(), pixel_of(1, 1 + 10 * 'c').text());
  display.send("b", 2, 1);
  display.send("a", 2, 0);
  display.assembly.swapped(2, {}, {{0, "a"}, {1, "c"}});
  EXPECT_FALSE(display.assembly.next_frame(kStart)) << "c has yet to send it";
  display.send("c", 2, 1);
  EXPECT_TRUE(display.assembly.next_frame(kStart));
}

TEST(DisplayAssembly, ANodeThatHasNeverComeIsWaitedFor) {
  Shared display;
  display.send("a", 1, 0);
  display.assembly.swapped(1, {}, {{0, "a"}, {1, "late"}});
  EXPECT_FALSE(display.assembly.next_frame(kStart + 1h));
  EXPECT_EQ(display.assembly.dropped_frames(), 0u);
  display.come("late", kStart + 1h);
  EXPECT_TRUE(display.assembly.image_came("late", image_of(1, 1, 1), pixel_of(1, 1), kStart + 1h));
  EXPECT_TRUE(display.assembly.next_frame(kStart + 1h));
}

TEST(DisplayAssembly, ANodeThatLeftIsWaitedForALittleAndItsFrameGivenUpThen) {
  Shared display;
  display.send("a", 1, 0);
  display.assembly.swapped(1, {}, {{0, "a"}, {1, "b"}});
  display.assembly.node_left("b", kStart);
  EXPECT_FALSE(display.assembly.next_frame(kStart + FrameAssembly::kReturnPatience - 1ms));
  EXPECT_EQ(display.assembly.dropped_frames(), 0u);
  EXPECT_FALSE(display.assembly.next_frame(kStart + FrameAssembly::kReturnPatience));
  EXPECT_EQ(display.assembly.dropped_frames(), 1u);
}

TEST(DisplayAssembly, ARestartedNodeCannotBringImagesOfBefore) {
  Shared display;
  display.send("a", 1, 0);
  display.assembly.swapped(1, {}, {{0, "a"}, {1, "b"}});
  display.come("b", kStart + 100ms);  // another process, or the same with another connection: it may send them again
  EXPECT_FALSE(display.assembly.next_frame(kStart + 200ms));
  EXPECT_EQ(display.assembly.dropped_frames(), 0u);
  EXPECT_FALSE(display.assembly.next_frame(kStart + 100ms + FrameAssembly::kReturnPatience));
  EXPECT_EQ(display.assembly.dropped_frames(), 1u);
}

TEST(DisplayAssembly, ASwapThatIsSaidAgainHoldsNoFrameBack) {
  Shared display;
  const FrameAssembly::Owners owners{{0, "a"}, {1, "b"}};
  display.send("a", 1, 0);
  display.assembly.swapped(1, {}, owners);
  display.come("b", kStart + 100ms);
  display.assembly.swapped(1, {}, owners);
  EXPECT_FALSE(display.assembly.next_frame(kStart + 100ms + FrameAssembly::kReturnPatience));
  EXPECT_EQ(display.assembly.dropped_frames(), 1u);
  EXPECT_TRUE(display.assembly.is_past(1));
}

TEST(DisplayAssembly, WhatWasLostWithTheConnectionIsSentAgain) {
  FrameAssembly assembly;
  assembly.configure(2, kOnePixel);
  const auto send = [&](std::uint32_t module) {
    return assembly.image_came("a", image_of(1, module, 2), pixel_of(1, module), kStart);
  };
  const auto come = [&] {
    EXPECT_TRUE(assembly.node_came("a", kStart));
    EXPECT_GE(assembly.credit_for("a"), 2u);
  };
  come();
  ASSERT_TRUE(send(1));  // module 0 was lost
  come();
  EXPECT_EQ(assembly.waiting_images(), 0u);
  ASSERT_TRUE(send(0));
  ASSERT_TRUE(send(1));
  come();
  EXPECT_TRUE(send(0)) << "here already, and sent again: no fault";
  EXPECT_EQ(assembly.waiting_images(), 2u);
  assembly.swapped(1, {});
  EXPECT_TRUE(assembly.next_frame(kStart));
}

TEST(DisplayAssembly, AFrameWithoutHopeDoesNotHoldTheCreditsOfOthers) {
  FrameAssembly assembly;
  assembly.configure(2, kOnePixel, {}, 1);  // one frame at a time
  for (const char* node : {"a", "b"}) EXPECT_TRUE(assembly.node_came(node, kStart));
  ASSERT_EQ(assembly.credit_for("a"), 1u);
  ASSERT_EQ(assembly.credit_for("b"), 1u);
  ASSERT_TRUE(assembly.image_came("a", image_of(1, 0, 1), pixel_of(1, 0), kStart));
  ASSERT_EQ(assembly.credit_for("a"), 0u);
  assembly.swapped(1, {}, {{0, "a"}, {1, "b"}});
  EXPECT_FALSE(assembly.next_frame(kStart));
  const std::uint32_t stale[] = {1};
  assembly.swapped(2, stale, {{0, "a"}});  // b is out, as the controller sees it
  EXPECT_FALSE(assembly.next_frame(kStart));
  EXPECT_EQ(assembly.dropped_frames(), 1u);
  ASSERT_EQ(assembly.credit_for("a"), 1u);
  ASSERT_TRUE(assembly.image_came("a", image_of(2, 0, 1), pixel_of(2, 0), kStart));
  const auto frame = assembly.next_frame(kStart);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->fresh_modules, 1);
}

}  // namespace
}  // namespace lfd::display
