// Compressed in steps, so that one that is not wanted any more ends soon.
#include "proto/images/zstd.h"

#include <zstd.h>

#include <algorithm>

#include "base/check.h"
#include "base/log.h"

namespace lfd {
namespace {

// At the highest level a step takes about a tenth of a second.
constexpr std::size_t kStep_bytes = 128 << 10;

}  // namespace

ZstdEncoder::ZstdEncoder() : context_(ZSTD_createCCtx()) { LFD_CHECK(context_ != nullptr, "no memory"); }
ZstdEncoder::~ZstdEncoder() { ZSTD_freeCCtx(context_); }

std::optional<std::string> ZstdEncoder::encode(std::string_view bytes, int level, const std::atomic<bool>* gives_up) {
  ZSTD_CCtx_reset(context_, ZSTD_reset_session_only);
  ZSTD_CCtx_setParameter(context_, ZSTD_c_compressionLevel, level);
  ZSTD_CCtx_setPledgedSrcSize(context_, bytes.size());
  scratch_.resize(std::max(scratch_.size(), ZSTD_compressBound(bytes.size())));
  ZSTD_outBuffer out{scratch_.data(), scratch_.size(), 0};
  for (std::size_t at = 0;;) {
    if (gives_up != nullptr && *gives_up) return std::nullopt;
    const std::size_t step = std::min(kStep_bytes, bytes.size() - at);
    const bool is_last = at + step == bytes.size();
    ZSTD_inBuffer in{bytes.data() + at, step, 0};
    const std::size_t left = ZSTD_compressStream2(context_, &out, &in, is_last ? ZSTD_e_end : ZSTD_e_continue);
    LFD_CHECK(!ZSTD_isError(left) && in.pos == in.size, "the bound of a frame's size holds");
    at += step;
    if (is_last && left == 0) return std::string(scratch_, 0, out.pos);
  }
}

Status check_zstd(std::string_view payload, std::size_t bytes) {
  const unsigned long long content = ZSTD_getFrameContentSize(payload.data(), payload.size());
  if (content == ZSTD_CONTENTSIZE_ERROR) return Error("zstd: not a frame");
  if (content == ZSTD_CONTENTSIZE_UNKNOWN) return Error("zstd: the frame does not say how many bytes it holds");
  if (content != bytes) return Error(fmt::format("zstd: a frame of {} bytes; {} make its pixels", content, bytes));
  return {};
}

Result<std::string> decode_zstd(std::string_view payload, std::size_t bytes) {
  LFD_TRY_STATUS(check_zstd(payload, bytes));
  std::string out(bytes, '\0');
  const std::size_t written = ZSTD_decompress(out.data(), out.size(), payload.data(), payload.size());
  if (ZSTD_isError(written)) return Error(fmt::format("zstd: {}", ZSTD_getErrorName(written)));
  if (written != bytes) return Error(fmt::format("zstd: {} bytes came out of a frame of {}", written, bytes));
  return out;
}

}  // namespace lfd
