// What is encoded comes back, is never larger than its pixels, and what is damaged is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

#include "proto/images/image_payload.h"

namespace lfd {
namespace {

using testing::HasSubstr;

constexpr int kWidth = 64, kHeight = 48;

proto::Image header_of(proto::BufferKind buffer) {
  proto::Image what;
  what.set_buffer(buffer);
  what.set_format(buffer == proto::COLOR ? proto::RGBA8 : proto::RGBA32F);
  what.set_width_px(kWidth);
  what.set_height_px(kHeight);
  return what;
}

// A smooth picture: what modules show most of the time.
wire::Payload smooth(const proto::Image& what) {
  auto bytes = std::make_shared<std::string>(pixel_bytes(what), '\0');
  for (std::size_t i = 0; i < bytes->size(); ++i)
    (*bytes)[i] = static_cast<char>(i % 4 == 3 ? 255 : (i / 4 % kWidth) * 2 + (i / 4 / kWidth));
  return std::shared_ptr<const std::string>(bytes);
}

wire::Payload noise(const proto::Image& what) {
  std::mt19937 random(1);
  auto bytes = std::make_shared<std::string>(pixel_bytes(what), '\0');
  for (char& byte : *bytes) byte = static_cast<char>(random());
  return std::shared_ptr<const std::string>(bytes);
}

proto::Stream stream_of(proto::Codec codec) {
  proto::Stream stream;
  stream.set_codec(codec);
  return stream;
}

struct Sent {
  proto::Image what;
  wire::Payload payload;
};

Sent sent(const proto::Stream& stream, proto::Image what, const wire::Payload& pixels) {
  PayloadEncoder encoder;
  const auto encoded = encoder.encode(stream, what, pixels);
  what.set_encoding(encoded->encoding);
  return {what, encoded->payload};
}

std::string refusal(const proto::Image& what, const std::string& payload) {
  const wire::Payload bytes(std::make_shared<const std::string>(payload));
  if (const Status status = check_payload(what, bytes); !status) return status.error().message();
  const auto pixels = decode_payload(what, bytes);
  return pixels ? "" : pixels.error().message();
}

TEST(ImagePayload, ZstdLosesNothingAtAnyLevelAndOfAnyBuffer) {
  for (const auto buffer : {proto::COLOR, proto::POSITION, proto::AO}) {
    for (const int level : {1, 3, 9, 19}) {
      proto::Stream stream = stream_of(proto::ZSTD_IMAGES);
      stream.set_level(level);
      const wire::Payload pixels = smooth(header_of(buffer));
      const Sent image = sent(stream, header_of(buffer), pixels);
      EXPECT_EQ(image.what.encoding(), proto::ZSTD);
      EXPECT_LT(image.payload.size(), pixels.size() / 4);
      ASSERT_TRUE(check_payload(image.what, image.payload));
      EXPECT_EQ(decode_payload(image.what, image.payload)->text(), pixels.text());
    }
  }
}

TEST(ImagePayload, JpegIsCloseAndOfColourAlone) {
  proto::Stream stream = stream_of(proto::JPEG_IMAGES);
  stream.set_quality(95);
  const wire::Payload pixels = smooth(header_of(proto::COLOR));
  const Sent image = sent(stream, header_of(proto::COLOR), pixels);
  ASSERT_EQ(image.what.encoding(), proto::JPEG);
  ASSERT_TRUE(check_payload(image.what, image.payload));
  const auto decoded = decode_payload(image.what, image.payload);
  ASSERT_TRUE(decoded) << decoded.error().message();
  ASSERT_EQ(decoded->size(), pixels.size());
  int worst = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i)
    worst = std::max(
        worst, std::abs(static_cast<unsigned char>(decoded->text()[i]) - static_cast<unsigned char>(pixels.text()[i])));
  EXPECT_LE(worst, 8);
  EXPECT_EQ(static_cast<unsigned char>(decoded->text()[3]), 255);
  EXPECT_EQ(sent(stream, header_of(proto::DEPTH), smooth(header_of(proto::DEPTH))).what.encoding(), proto::ZSTD);
}

TEST(ImagePayload, NothingIsLargerThanItsPixels) {
  const wire::Payload pixels = noise(header_of(proto::COLOR));
  const Sent image = sent(stream_of(proto::ZSTD_IMAGES), header_of(proto::COLOR), pixels);
  EXPECT_EQ(image.what.encoding(), proto::RAW);
  EXPECT_EQ(image.payload.bytes().data(), pixels.bytes().data()) << "not copied";
  proto::Image tiny = header_of(proto::COLOR);
  tiny.set_width_px(2);
  tiny.set_height_px(2);  // the header of a JPEG is larger
  EXPECT_EQ(sent(stream_of(proto::JPEG_IMAGES), tiny, smooth(tiny)).what.encoding(), proto::RAW);
}

TEST(ImagePayload, EncodingEndsWhereItIsNotWantedAnyMore) {
  const std::atomic<bool> gives_up = true;
  PayloadEncoder encoder;
  EXPECT_FALSE(encoder.encode(stream_of(proto::ZSTD_IMAGES), header_of(proto::DEPTH), smooth(header_of(proto::DEPTH)),
                              &gives_up));
}

TEST(ImagePayload, WhatIsNotTheImageIsRefusedWithTheReason) {
  const Sent zstd = sent(stream_of(proto::ZSTD_IMAGES), header_of(proto::COLOR), smooth(header_of(proto::COLOR)));
  const Sent jpeg = sent(stream_of(proto::JPEG_IMAGES), header_of(proto::COLOR), smooth(header_of(proto::COLOR)));
  const std::string bytes(zstd.payload.text()), picture(jpeg.payload.text());
  EXPECT_EQ(refusal(zstd.what, bytes), "");
  EXPECT_EQ(refusal(jpeg.what, picture), "");
  EXPECT_THAT(refusal(zstd.what, ""), HasSubstr("0 bytes encode 12288 of pixels"));
  EXPECT_THAT(refusal(zstd.what, "garbage that is no frame"), HasSubstr("zstd: not a frame"));
  EXPECT_THAT(refusal(zstd.what, std::string(20000, 'x')), HasSubstr("20000 bytes encode 12288 of pixels"));
  EXPECT_THAT(refusal(zstd.what, bytes.substr(0, bytes.size() - 1)), HasSubstr("zstd: "));
  EXPECT_THAT(refusal(zstd.what, bytes + "x"), HasSubstr("zstd: "));
  EXPECT_THAT(refusal(zstd.what, bytes + bytes), HasSubstr("zstd: "));
  proto::Image wide = zstd.what;
  wide.set_width_px(kWidth + 1);
  EXPECT_THAT(refusal(wide, bytes), HasSubstr("a frame of 12288 bytes; 12480 make its pixels"));
  wide.set_encoding(proto::JPEG);
  EXPECT_THAT(refusal(wide, picture), HasSubstr("JPEG: 64 x 48 pixels instead of 65 x 48"));
  EXPECT_THAT(refusal(jpeg.what, picture.substr(0, picture.size() / 2)), HasSubstr("JPEG: "));
  EXPECT_THAT(refusal(jpeg.what, bytes), HasSubstr("JPEG: "));
  proto::Image depth = header_of(proto::DEPTH);
  depth.set_encoding(proto::JPEG);
  EXPECT_THAT(refusal(depth, picture), HasSubstr("JPEG is of colour alone"));
  depth.set_encoding(static_cast<proto::Encoding>(7));
  EXPECT_THAT(refusal(depth, picture), HasSubstr("unknown"));
}

TEST(ImagePayload, AnyDamageIsRefusedOrGivesAWholePicture) {
  std::mt19937 random(3);
  for (const auto codec : {proto::ZSTD_IMAGES, proto::JPEG_IMAGES}) {
    const Sent image = sent(stream_of(codec), header_of(proto::COLOR), smooth(header_of(proto::COLOR)));
    for (int trial = 0; trial < 500; ++trial) {
      std::string bytes(image.payload.text());
      for (int i = 0; i < 3; ++i) bytes[random() % bytes.size()] = static_cast<char>(random());
      const wire::Payload damaged(std::make_shared<const std::string>(bytes));
      if (!check_payload(image.what, damaged)) continue;
      const auto pixels = decode_payload(image.what, damaged);
      EXPECT_TRUE(!pixels || pixels->size() == pixel_bytes(image.what));
    }
  }
}

}  // namespace
}  // namespace lfd
