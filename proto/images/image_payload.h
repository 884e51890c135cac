// How the pixels of an image travel: encoding them, looking at what came, decoding it.
#pragma once

#include <atomic>
#include <cstddef>
#include <optional>

#include "base/result.h"
#include "proto/images/turbo_jpeg.h"
#include "proto/images/zstd.h"
#include "proto/wire.pb.h"
#include "proto/wire/payload.h"

namespace lfd {

inline constexpr int kDefaultZstdLevel = 1;
inline constexpr int kDefaultJpegQuality = 90;

// Of the image's pixels, as its size and format say; no payload is larger.
std::size_t pixel_bytes(const proto::Image& what);

// Keeps its memory from one image to the next. One thread.
class PayloadEncoder {
 public:
  struct Encoded {
    proto::Encoding encoding = proto::RAW;
    wire::Payload payload;
  };

  // Of an image that is not empty. What an encoding would not make smaller travels as it is, and is not copied. Absent
  // where `gives_up` turns true meanwhile.
  std::optional<Encoded> encode(const proto::Stream& stream, const proto::Image& what, const wire::Payload& pixels,
                                const std::atomic<bool>* gives_up = nullptr);

 private:
  ZstdEncoder zstd_;
  JpegEncoder jpeg_;
};

// Whether the payload can be that image's, as far as its size and its first bytes say; cheap.
Status check_payload(const proto::Image& what, const wire::Payload& payload);

// The pixels. Whatever the bytes are, no more memory is taken than the pixels need, beside a little that does not
// depend on them (JPEG that is progressive: three times as much).
Result<wire::Payload> decode_payload(const proto::Image& what, const wire::Payload& payload);

}  // namespace lfd
