// PNG files in and out; the one door of libpng.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/result.h"
#include "proto/pictures/picture.h"

namespace lfd {

enum class PngChannels { kRgb, kRgba };

// Compressed for speed. The picture must not be empty.
Result<std::string> encode_png(const Picture8& picture, PngChannels channels = PngChannels::kRgba);

// Every kind of PNG to RGBA of 8 bits. Errors: damaged or cut off, more than kMaxPicturePixels.
Result<Picture8> decode_png(std::string_view file);

// Whole files; errors name the path. Missing folders are made, and readers never see half a file.
Status write_png(const std::filesystem::path& path, const Picture8& picture, PngChannels channels = PngChannels::kRgba);
Result<Picture8> read_png(const std::filesystem::path& path);

}  // namespace lfd
