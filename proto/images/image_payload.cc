// Which encoding an image gets, and what holds of each.
#include "proto/images/image_payload.h"

#include <memory>
#include <string>

#include "base/log.h"

namespace lfd {
namespace {

// JPEG cannot be larger; images are smaller anyway.
constexpr std::uint32_t kMaxJpegSide_px = 65500;

bool goes_as_jpeg(const proto::Stream& stream, const proto::Image& what) {
  return stream.codec() == proto::JPEG_IMAGES && what.buffer() == proto::COLOR && what.width_px() <= kMaxJpegSide_px &&
         what.height_px() <= kMaxJpegSide_px;
}

wire::Payload payload_of(std::string&& bytes) { return std::make_shared<const std::string>(std::move(bytes)); }

int width_of(const proto::Image& what) { return static_cast<int>(what.width_px()); }
int height_of(const proto::Image& what) { return static_cast<int>(what.height_px()); }

}  // namespace

std::size_t pixel_bytes(const proto::Image& what) {
  const std::size_t pixels = std::size_t{what.width_px()} * what.height_px();
  return pixels * (what.format() == proto::RGBA8 ? 4 : 16);
}

std::optional<PayloadEncoder::Encoded> PayloadEncoder::encode(const proto::Stream& stream, const proto::Image& what,
                                                              const wire::Payload& pixels,
                                                              const std::atomic<bool>* gives_up) {
  const Encoded raw{proto::RAW, pixels};
  if (stream.codec() == proto::RAW_IMAGES) return raw;
  if (goes_as_jpeg(stream, what)) {
    const int quality = stream.has_quality() ? stream.quality() : kDefaultJpegQuality;
    std::string jpeg = jpeg_.encode(pixels.text(), width_of(what), height_of(what), quality);
    return jpeg.size() < pixels.size() ? Encoded{proto::JPEG, payload_of(std::move(jpeg))} : raw;
  }
  const int level = stream.has_level() ? stream.level() : kDefaultZstdLevel;
  auto zstd = zstd_.encode(pixels.text(), level, gives_up);
  if (!zstd) return std::nullopt;
  return zstd->size() < pixels.size() ? Encoded{proto::ZSTD, payload_of(*std::move(zstd))} : raw;
}

Status check_payload(const proto::Image& what, const wire::Payload& payload) {
  const std::size_t bytes = pixel_bytes(what);
  if (what.encoding() == proto::RAW) {
    if (payload.size() == bytes) return {};
    return Error(fmt::format("{} bytes; {} make its pixels", payload.size(), bytes));
  }
  if (payload.empty() || payload.size() >= bytes)
    return Error(fmt::format("{} bytes encode {} of pixels", payload.size(), bytes));
  if (what.encoding() == proto::ZSTD) return check_zstd(payload.text(), bytes);
  if (what.encoding() != proto::JPEG) return Error("its encoding is unknown");
  if (what.buffer() != proto::COLOR || what.format() != proto::RGBA8) return Error("JPEG is of colour alone");
  return check_jpeg(payload.text(), width_of(what), height_of(what));
}

Result<wire::Payload> decode_payload(const proto::Image& what, const wire::Payload& payload) {
  if (what.encoding() == proto::RAW) return payload;
  LFD_TRY(std::string pixels, what.encoding() == proto::JPEG
                                  ? decode_jpeg_pixels(payload.text(), width_of(what), height_of(what))
                                  : decode_zstd(payload.text(), pixel_bytes(what)));
  return payload_of(std::move(pixels));
}

}  // namespace lfd
