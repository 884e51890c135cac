// libpng reports errors by longjmp: the functions that it may leave hold nothing that needs a destructor.
#include "proto/pictures/png.h"

#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>

#include "base/file.h"
#include "base/log.h"

namespace lfd {
namespace {

constexpr png_alloc_size_t kMaxChunk_bytes = 8 << 20;  // of text and colour profiles, which are of no use here
constexpr png_uint_32 kMaxSide_px = 1 << 20;

struct Decoder {
  const char* next;
  std::size_t left;
  char message[200] = "";
  png_structp png = nullptr;
  png_infop info = nullptr;

  explicit Decoder(std::string_view file) : next(file.data()), left(file.size()) {
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, fail, [](png_structp, png_const_charp) {});
    LFD_CHECK(png != nullptr, "libpng of another version, or no memory");
    info = png_create_info_struct(png);
    LFD_CHECK(info != nullptr, "no memory");
    png_set_read_fn(png, this, read);
    png_set_user_limits(png, kMaxSide_px, kMaxSide_px);
    png_set_chunk_malloc_max(png, kMaxChunk_bytes);
  }
  ~Decoder() { png_destroy_read_struct(&png, &info, nullptr); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  static void fail(png_structp png, png_const_charp what) {
    auto* decoder = static_cast<Decoder*>(png_get_error_ptr(png));
    std::strncpy(decoder->message, what, sizeof(decoder->message) - 1);
    png_longjmp(png, 1);
  }
  static void read(png_structp png, png_bytep to, png_size_t count) {
    auto* decoder = static_cast<Decoder*>(png_get_io_ptr(png));
    if (count > decoder->left) png_error(png, "the file ends too early");
    std::memcpy(to, decoder->next, count);
    decoder->next += count;
    decoder->left -= count;
  }
};

bool read_header(Decoder& decoder) {
  if (setjmp(png_jmpbuf(decoder.png)) != 0) return false;
  png_read_info(decoder.png, decoder.info);
  return true;
}

bool read_rows(Decoder& decoder, std::uint8_t* rgba, std::size_t stride, int height) {
  if (setjmp(png_jmpbuf(decoder.png)) != 0) return false;
  png_set_expand(decoder.png);
  png_set_scale_16(decoder.png);
  png_set_gray_to_rgb(decoder.png);
  png_set_add_alpha(decoder.png, 0xff, PNG_FILLER_AFTER);
  const int passes = png_set_interlace_handling(decoder.png);
  png_read_update_info(decoder.png, decoder.info);
  if (png_get_rowbytes(decoder.png, decoder.info) != stride) png_error(decoder.png, "rows of an unexpected length");
  for (int pass = 0; pass < passes; ++pass) {
    for (int row = 0; row < height; ++row) png_read_row(decoder.png, rgba + stride * row, nullptr);
  }
  png_read_end(decoder.png, nullptr);
  return true;
}

std::vector<std::uint8_t> without_alpha(const Picture8& picture) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(picture.rgba.size() / 4 * 3);
  for (std::size_t at = 0; at < picture.rgba.size(); at += 4) {
    rgb.insert(rgb.end(), picture.rgba.begin() + at, picture.rgba.begin() + at + 3);
  }
  return rgb;
}

}  // namespace

Result<std::string> encode_png(const Picture8& picture, PngChannels channels) {
  LFD_CHECK(picture.width > 0 && picture.height > 0, "an empty picture");
  LFD_CHECK(picture.rgba.size() == std::size_t{4} * picture.width * picture.height, "a picture of the wrong size");
  const bool is_rgb = channels == PngChannels::kRgb;
  const std::vector<std::uint8_t> rgb = is_rgb ? without_alpha(picture) : std::vector<std::uint8_t>();
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = is_rgb ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
  image.flags = PNG_IMAGE_FLAG_FAST;
  std::string file(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
  png_alloc_size_t size = file.size();
  const void* pixels = is_rgb ? rgb.data() : picture.rgba.data();
  if (png_image_write_to_memory(&image, file.data(), &size, 0, pixels, 0, nullptr) == 0) {
    return Error(fmt::format("PNG: {}", image.message));
  }
  file.resize(size);
  return file;
}

Result<Picture8> decode_png(std::string_view file) {
  Decoder decoder(file);
  if (!read_header(decoder)) return Error(fmt::format("PNG: {}", decoder.message));
  const std::size_t width = png_get_image_width(decoder.png, decoder.info);
  const std::size_t height = png_get_image_height(decoder.png, decoder.info);
  if (width * height > kMaxPicturePixels) {
    return Error(fmt::format("PNG: {} x {} pixels; at most {} are read", width, height, kMaxPicturePixels));
  }
  Picture8 picture = black_picture(static_cast<int>(width), static_cast<int>(height));
  if (!read_rows(decoder, picture.rgba.data(), 4 * width, picture.height))
    return Error(fmt::format("PNG: {}", decoder.message));
  return picture;
}

Status write_png(const std::filesystem::path& path, const Picture8& picture, PngChannels channels) {
  const auto file = encode_png(picture, channels);
  if (!file) return file.error().within(path.string());
  return write_file(path, *file);
}

Result<Picture8> read_png(const std::filesystem::path& path) {
  LFD_TRY(const std::string file, read_file(path));
  auto picture = decode_png(file);
  if (!picture) return picture.error().within(path.string());
  return picture;
}

}  // namespace lfd
