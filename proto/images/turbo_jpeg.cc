// The simple interface of libjpeg-turbo: no callbacks, nothing jumps out of it.
#include "proto/images/turbo_jpeg.h"

#include <turbojpeg.h>

#include <algorithm>
#include <memory>
#include <type_traits>

#include "base/check.h"
#include "base/log.h"

namespace lfd {
namespace {

struct Destroy {
  void operator()(void* handle) const { tjDestroy(handle); }
};
using Handle = std::unique_ptr<void, Destroy>;

const unsigned char* bytes_of(std::string_view text) { return reinterpret_cast<const unsigned char*>(text.data()); }

Status check_header(void* decoder, std::string_view payload, int width_px, int height_px) {
  int width = 0, height = 0, subsampling = 0, colours = 0;
  if (tjDecompressHeader3(decoder, bytes_of(payload), payload.size(), &width, &height, &subsampling, &colours) != 0)
    return Error(fmt::format("JPEG: {}", tjGetErrorStr2(decoder)));
  if (width != width_px || height != height_px)
    return Error(fmt::format("JPEG: {} x {} pixels instead of {} x {}", width, height, width_px, height_px));
  if (colours != TJCS_YCbCr || subsampling != TJSAMP_444) return Error("JPEG: not in full colour");
  return {};
}

}  // namespace

JpegEncoder::JpegEncoder() : handle_(tjInitCompress()) { LFD_CHECK(handle_ != nullptr, "no memory"); }
JpegEncoder::~JpegEncoder() { tjDestroy(handle_); }

std::string JpegEncoder::encode(std::string_view rgba, int width_px, int height_px, int quality) {
  LFD_CHECK(rgba.size() == std::size_t{4} * width_px * height_px, "all pixels are there");
  unsigned long size = tjBufSize(width_px, height_px, TJSAMP_444);
  scratch_.resize(std::max<std::size_t>(scratch_.size(), size));
  unsigned char* out = reinterpret_cast<unsigned char*>(scratch_.data());
  const int failed = tjCompress2(handle_, bytes_of(rgba), width_px, 0, height_px, TJPF_RGBA, &out, &size, TJSAMP_444,
                                 quality, TJFLAG_NOREALLOC);
  LFD_CHECK(failed == 0, tjGetErrorStr2(handle_));
  return std::string(scratch_, 0, size);
}

Status check_jpeg(std::string_view payload, int width_px, int height_px) {
  const Handle decoder(tjInitDecompress());
  LFD_CHECK(decoder != nullptr, "no memory");
  return check_header(decoder.get(), payload, width_px, height_px);
}

Result<std::string> decode_jpeg_pixels(std::string_view payload, int width_px, int height_px) {
  const Handle decoder(tjInitDecompress());
  LFD_CHECK(decoder != nullptr, "no memory");
  LFD_TRY_STATUS(check_header(decoder.get(), payload, width_px, height_px));
  std::string rgba(std::size_t{4} * width_px * height_px, '\0');
  // A progressive file may hold any number of scans, each of which costs a pass over the whole picture.
  const int failed =
      tjDecompress2(decoder.get(), bytes_of(payload), payload.size(), reinterpret_cast<unsigned char*>(rgba.data()),
                    width_px, 0, height_px, TJPF_RGBA, TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS);
  if (failed != 0) return Error(fmt::format("JPEG: {}", tjGetErrorStr2(decoder.get())));
  return rgba;
}

}  // namespace lfd
