// Fuzz target: payloads of images, of an encoding that the first byte chooses (z: zstd, j: JPEG, else raw), are refused
// or give all pixels.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "base/check.h"
#include "proto/images/image_payload.h"

// The second byte chooses the buffer.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  lfd::proto::Image what;
  what.set_encoding(data[0] == 'z' ? lfd::proto::ZSTD : data[0] == 'j' ? lfd::proto::JPEG : lfd::proto::RAW);
  what.set_buffer(data[1] == 'd' ? lfd::proto::DEPTH : lfd::proto::COLOR);
  what.set_format(data[1] == 'd' ? lfd::proto::RGBA32F : lfd::proto::RGBA8);
  what.set_width_px(32);
  what.set_height_px(24);
  const lfd::wire::Payload payload(
      std::make_shared<const std::string>(reinterpret_cast<const char*>(data) + 2, size - 2));
  if (!lfd::check_payload(what, payload)) return 0;
  LFD_CHECK(payload.size() <= lfd::pixel_bytes(what), "no payload is larger than its pixels");
  const auto pixels = lfd::decode_payload(what, payload);
  if (pixels) LFD_CHECK(pixels->size() == lfd::pixel_bytes(what), "all pixels are there");
  return 0;
}
