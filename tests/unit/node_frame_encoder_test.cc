// Images of frames are encoded on other threads, and what has not changed is the very payload of before.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "proto/wire/poll.h"
#include "rendernode/node/frame_encoder.h"

namespace lfd::node {
namespace {

constexpr int kWidth = 64, kHeight = 48;

std::shared_ptr<const std::string> picture(int seed) {
  auto pixels = std::make_shared<std::string>(std::size_t{4} * kWidth * kHeight, '\0');
  for (std::size_t i = 0; i < pixels->size(); ++i) (*pixels)[i] = static_cast<char>(i / 256 + seed);
  return pixels;
}

OutgoingImage image_of(std::uint32_t module, wire::Payload pixels) {
  OutgoingImage image;
  image.header.set_module(module);
  image.header.set_width_px(kWidth);
  image.header.set_height_px(kHeight);
  image.header.set_empty(pixels.empty());
  image.payload = std::move(pixels);
  return image;
}

std::vector<OutgoingImage> encoded(FrameEncoder& encoder, proto::Codec codec, std::vector<OutgoingImage> images) {
  proto::Stream stream;
  stream.set_codec(codec);
  encoder.put(stream, std::move(images));
  EXPECT_FALSE(encoder.idle());
  while (wire::wait({}, {encoder.descriptor()}, std::chrono::seconds(30))) {
    if (auto done = encoder.take()) return *std::move(done);
  }
  ADD_FAILURE() << "nothing is done";
  return {};
}

TEST(FrameEncoder, KeepsOrderHeadersAndEmptyImages) {
  FrameEncoder encoder;
  std::vector<OutgoingImage> images;
  for (std::uint32_t module = 0; module < 40; ++module)
    images.push_back(image_of(module, module % 3 == 0 ? wire::Payload() : wire::Payload(picture(module))));
  const auto done = encoded(encoder, proto::ZSTD_IMAGES, images);
  ASSERT_EQ(done.size(), 40u);
  for (std::uint32_t module = 0; module < 40; ++module) {
    EXPECT_EQ(done[module].header.module(), module);
    EXPECT_EQ(done[module].payload.empty(), module % 3 == 0);
    if (module % 3 == 0) continue;
    EXPECT_EQ(done[module].header.encoding(), proto::ZSTD);
    EXPECT_EQ(decode_payload(done[module].header, done[module].payload)->text(), *picture(module));
  }
  EXPECT_TRUE(encoder.idle());
  EXPECT_EQ(encoded(encoder, proto::JPEG_IMAGES, {image_of(0, {}), image_of(1, {})}).size(), 2u);
}

TEST(FrameEncoder, RawPixelsAreNotCopied) {
  FrameEncoder encoder;
  const auto pixels = picture(1);
  const auto done = encoded(encoder, proto::RAW_IMAGES, {image_of(0, pixels)});
  EXPECT_EQ(done.at(0).payload.text().data(), pixels->data());
}

TEST(FrameEncoder, WhatDidNotChangeIsTheVeryPayloadOfBefore) {
  for (const auto codec : {proto::RAW_IMAGES, proto::ZSTD_IMAGES, proto::JPEG_IMAGES}) {
    FrameEncoder encoder;
    const auto same = picture(1);
    const auto first = encoded(encoder, codec, {image_of(0, same), image_of(1, picture(2)), image_of(2, picture(3))});
    const auto then = encoded(encoder, codec, {image_of(0, same), image_of(1, picture(2)), image_of(2, picture(4))});
    ASSERT_EQ(then.size(), 3u);
    EXPECT_EQ(first[0].payload.bytes().data(), then[0].payload.bytes().data()) << "the same in memory";
    EXPECT_EQ(first[1].payload.bytes().data(), then[1].payload.bytes().data()) << "equal";
    EXPECT_NE(first[2].payload.bytes().data(), then[2].payload.bytes().data());
    EXPECT_EQ(then[1].header.encoding(), first[1].header.encoding());
  }
}

TEST(FrameEncoder, WithOtherSettingsEverythingIsEncodedAgain) {
  FrameEncoder encoder;
  const auto same = picture(1);
  encoded(encoder, proto::RAW_IMAGES, {image_of(0, same)});
  EXPECT_EQ(encoded(encoder, proto::ZSTD_IMAGES, {image_of(0, same)}).at(0).header.encoding(), proto::ZSTD);
}

TEST(FrameEncoder, AFrameThatIsGivenUpNeverComes) {
  FrameEncoder encoder;
  proto::Stream slow;
  slow.set_codec(proto::ZSTD_IMAGES);
  slow.set_level(19);
  for (int trial = 0; trial < 20; ++trial) {
    encoder.put(slow, {image_of(0, picture(trial)), image_of(1, picture(trial))});
    encoder.give_up();
    EXPECT_TRUE(encoder.idle());
  }
  const auto done = encoded(encoder, proto::RAW_IMAGES, {image_of(7, picture(7))});
  ASSERT_EQ(done.size(), 1u);
  EXPECT_EQ(done[0].header.module(), 7u);
}

}  // namespace
}  // namespace lfd::node
