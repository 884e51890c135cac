// libjpeg reports errors by longjmp: the functions that it may leave hold nothing that needs a destructor.
#include "proto/pictures/jpeg.h"

#include <csetjmp>
#include <cstdio>
// After cstdio, which it needs:
#include <jerror.h>
#include <jpeglib.h>

#include "base/log.h"

namespace lfd {
namespace {

// A progressive file may hold any number of scans, each of which costs a pass over the whole picture.
constexpr int kMaxScans = 200;

struct Decoder {
  jpeg_decompress_struct jpeg;
  jpeg_error_mgr errors;
  jpeg_progress_mgr progress;
  std::jmp_buf leave;
  char message[JMSG_LENGTH_MAX];

  Decoder() {
    jpeg.err = jpeg_std_error(&errors);
    jpeg.client_data = this;
    errors.error_exit = [](j_common_ptr common) { of(common)->fail(); };
    errors.emit_message = [](j_common_ptr common, int level) {
      const int code = common->err->msg_code;
      if (level < 0 && (code == JWRN_JPEG_EOF || code == JWRN_HIT_MARKER)) of(common)->fail();
    };
    errors.output_message = [](j_common_ptr) {};
    progress.progress_monitor = [](j_common_ptr common) {
      Decoder* decoder = of(common);
      if (decoder->jpeg.input_scan_number <= kMaxScans) return;
      std::snprintf(decoder->message, sizeof(decoder->message), "more than %d scans", kMaxScans);
      std::longjmp(decoder->leave, 1);
    };
    jpeg_create_decompress(&jpeg);
    jpeg.progress = &progress;
  }
  ~Decoder() { jpeg_destroy_decompress(&jpeg); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  static Decoder* of(j_common_ptr common) { return static_cast<Decoder*>(common->client_data); }

  [[noreturn]] void fail() {
    errors.format_message(reinterpret_cast<j_common_ptr>(&jpeg), message);
    std::longjmp(leave, 1);
  }
};

bool read_header(Decoder& decoder, const char* bytes, std::size_t size) {
  if (setjmp(decoder.leave) != 0) return false;
  jpeg_mem_src(&decoder.jpeg, reinterpret_cast<const unsigned char*>(bytes), size);
  jpeg_read_header(&decoder.jpeg, TRUE);
  decoder.jpeg.out_color_space = JCS_EXT_RGBA;  // alpha 255
  return true;
}

bool read_rows(Decoder& decoder, std::uint8_t* rgba) {
  if (setjmp(decoder.leave) != 0) return false;
  jpeg_start_decompress(&decoder.jpeg);
  const std::size_t stride = std::size_t{4} * decoder.jpeg.output_width;
  while (decoder.jpeg.output_scanline < decoder.jpeg.output_height) {
    JSAMPROW row = rgba + stride * decoder.jpeg.output_scanline;
    jpeg_read_scanlines(&decoder.jpeg, &row, 1);
  }
  jpeg_finish_decompress(&decoder.jpeg);
  return true;
}

}  // namespace

Result<Picture8> decode_jpeg(std::string_view file) {
  Decoder decoder;
  if (!read_header(decoder, file.data(), file.size())) return Error(fmt::format("JPEG: {}", decoder.message));
  const auto& jpeg = decoder.jpeg;
  if (jpeg.jpeg_color_space == JCS_CMYK || jpeg.jpeg_color_space == JCS_YCCK)
    return Error("JPEG: CMYK is not supported");
  if (std::size_t{jpeg.image_width} * jpeg.image_height > kMaxPicturePixels) {
    return Error(fmt::format("JPEG: {} x {} pixels; at most {} are read", jpeg.image_width, jpeg.image_height,
                             kMaxPicturePixels));
  }
  Picture8 picture = black_picture(static_cast<int>(jpeg.image_width), static_cast<int>(jpeg.image_height));
  if (!read_rows(decoder, picture.rgba.data())) return Error(fmt::format("JPEG: {}", decoder.message));
  return picture;
}

}  // namespace lfd
