// RGBA pixels to JPEG and back, without subsampling; the one door of libturbojpeg.
#pragma once

#include <string>
#include <string_view>

#include "base/result.h"

namespace lfd {

// Keeps its memory from one use to the next. One thread.
class JpegEncoder {
 public:
  JpegEncoder();
  ~JpegEncoder();
  JpegEncoder(const JpegEncoder&) = delete;
  JpegEncoder& operator=(const JpegEncoder&) = delete;

  // rgba: rows from the top, 4 bytes a pixel; alpha is lost. quality: 1 to 100. Sides: 1 to 65500.
  std::string encode(std::string_view rgba, int width_px, int height_px, int quality);

 private:
  void* handle_;
  std::string scratch_;
};

// Whether the payload begins as a JPEG of that size, in colour and without subsampling.
Status check_jpeg(std::string_view payload, int width_px, int height_px);

// 4 bytes a pixel, alpha 255. Damaged ones are errors, even where a picture could be made of the rest.
Result<std::string> decode_jpeg_pixels(std::string_view payload, int width_px, int height_px);

}  // namespace lfd
