// What a node sends when: credits, what has not changed, greetings, and beginning anew.
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>

#include "rendernode/node/image_outbox.h"

namespace lfd::node {
namespace {

using namespace std::chrono_literals;

const Clock::time_point kStart{};

proto::Credit credit(std::uint32_t images, bool anew = false) {
  proto::Credit credit;
  credit.set_images(images);
  credit.set_anew(anew);
  return credit;
}

wire::Payload bytes(const std::string& text) { return std::make_shared<const std::string>(text); }

// A frame of modules 0, 1, ... with these payloads.
std::vector<OutgoingImage> frame_of(std::uint64_t frame, const std::vector<wire::Payload>& payloads) {
  std::vector<OutgoingImage> images(payloads.size());
  for (std::uint32_t i = 0; i < images.size(); ++i) {
    images[i].header.set_frame(frame);
    images[i].header.set_module(i);
    images[i].payload = payloads[i];
  }
  return images;
}

// Sends all that may be sent; what has gone.
std::vector<OutgoingImage> send(ImageOutbox& outbox) {
  std::vector<OutgoingImage> gone;
  while (auto image = outbox.next()) {
    gone.push_back(*std::move(image));
    outbox.sent();
  }
  return gone;
}

TEST(ImageOutbox, SendsInOrderAsFarAsCreditsReach) {
  ImageOutbox outbox;
  const auto load = outbox.push(frame_of(1, {bytes("a"), bytes("bc"), bytes("d")}));
  EXPECT_EQ(load.bytes, 4u);
  EXPECT_EQ(load.unchanged, 0u);
  EXPECT_FALSE(outbox.next());
  outbox.credit_came(credit(2, true));
  const auto gone = send(outbox);
  ASSERT_EQ(gone.size(), 2u);
  EXPECT_EQ(gone[0].header.module(), 0u);
  EXPECT_EQ(gone[1].header.module(), 1u);
  EXPECT_FALSE(outbox.idle());
  outbox.credit_came(credit(1));
  EXPECT_EQ(send(outbox).size(), 1u);
  EXPECT_TRUE(outbox.idle());
}

TEST(ImageOutbox, CreditsOfALostDisplayCountNoMore) {
  ImageOutbox outbox;
  outbox.credit_came(credit(5, true));
  outbox.push(frame_of(1, {bytes("a")}));
  outbox.reconnected();
  EXPECT_FALSE(outbox.next());
  EXPECT_FALSE(outbox.idle());
}

TEST(ImageOutbox, WhatTheDisplayHasTravelsWithoutPayload) {
  ImageOutbox outbox;
  outbox.credit_came(credit(100, true));
  const auto still = bytes("still");
  outbox.push(frame_of(1, {still, bytes("moves")}));
  send(outbox);
  outbox.push(frame_of(2, {{}, bytes("moves")}));  // module 0 is empty for a while
  send(outbox);
  const auto load = outbox.push(frame_of(3, {still, bytes("moves")}));
  EXPECT_EQ(load.unchanged, 1u);
  EXPECT_EQ(load.bytes, 5u);
  const auto gone = send(outbox);
  ASSERT_EQ(gone.size(), 2u);
  EXPECT_EQ(gone[0].header.same_as_frame(), 1u) << "the last that came with a payload";
  EXPECT_TRUE(gone[0].payload.empty());
  EXPECT_FALSE(gone[1].header.has_same_as_frame()) << "equal, but not the very same bytes";
  EXPECT_EQ(gone[1].payload.text(), "moves");
}

TEST(ImageOutbox, AnewTheFrameGoesOnceMoreAndWhole) {
  ImageOutbox outbox;
  outbox.credit_came(credit(100, true));
  const auto still = bytes("still");
  outbox.push(frame_of(1, {still, still}));
  send(outbox);
  outbox.push(frame_of(2, {still, still}));
  EXPECT_EQ(send(outbox)[0].header.same_as_frame(), 1u);
  outbox.credit_came(credit(0, true));
  EXPECT_FALSE(outbox.idle());
  EXPECT_FALSE(outbox.next()) << "earlier credits are void";
  EXPECT_TRUE(outbox.greets(kStart));
  outbox.credit_came(credit(3, true));
  const auto again = send(outbox);
  ASSERT_EQ(again.size(), 2u);
  for (const auto& image : again) {
    EXPECT_EQ(image.header.frame(), 2u);
    EXPECT_EQ(image.payload.text(), "still");
  }
}

TEST(ImageOutbox, ClearedItSendsNothing) {
  ImageOutbox outbox;
  outbox.push(frame_of(1, {bytes("a")}));
  outbox.clear();
  EXPECT_TRUE(outbox.idle());
  outbox.credit_came(credit(5, true));
  EXPECT_FALSE(outbox.next());
}

TEST(ImageOutbox, GreetsOftenUntilItIsKnownAndWhereCreditStaysAway) {
  ImageOutbox outbox;
  const auto often = ImageOutbox::kHelloPause, seldom = ImageOutbox::kContentHelloPause;
  EXPECT_TRUE(outbox.greets(kStart));
  EXPECT_FALSE(outbox.greets(kStart + often - 1ms));
  EXPECT_TRUE(outbox.greets(kStart + often));
  outbox.credit_came(credit(1, true));
  EXPECT_FALSE(outbox.greets(kStart + often + seldom - 1ms)) << "known, and nothing waits";
  EXPECT_TRUE(outbox.greets(kStart + often + seldom)) << "the connection may be another one";
  outbox.push(frame_of(1, {bytes("a"), bytes("b")}));
  send(outbox);
  EXPECT_FALSE(outbox.greets(kStart + often + seldom + often - 1ms));
  EXPECT_TRUE(outbox.greets(kStart + often + seldom + often)) << "the second image waits for credit";
  outbox.credit_came(credit(1));
  EXPECT_FALSE(outbox.greets(kStart + often + seldom + often + seldom - 1ms));
}

}  // namespace
}  // namespace lfd::node
