// Bytes to frames of Zstandard and back; the one door of libzstd.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/result.h"

struct ZSTD_CCtx_s;

namespace lfd {

// Keeps its memory from one use to the next. One thread.
class ZstdEncoder {
 public:
  ZstdEncoder();
  ~ZstdEncoder();
  ZstdEncoder(const ZstdEncoder&) = delete;
  ZstdEncoder& operator=(const ZstdEncoder&) = delete;

  // One frame that names the size of `bytes`; level: 1 to 19. Absent where `gives_up` turns true meanwhile: a high
  // level takes seconds.
  std::optional<std::string> encode(std::string_view bytes, int level, const std::atomic<bool>* gives_up = nullptr);

 private:
  ZSTD_CCtx_s* context_;
  std::string scratch_;
};

// Whether the payload begins as a frame of so many bytes does; that it can be decoded is not said.
Status check_zstd(std::string_view payload, std::size_t bytes);

// Exactly so many bytes, which is also all the memory that it takes, beside some 200 KiB.
Result<std::string> decode_zstd(std::string_view payload, std::size_t bytes);

}  // namespace lfd
