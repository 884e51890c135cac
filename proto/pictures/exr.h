// OpenEXR files of four float channels in and out; the one door of OpenEXR.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/result.h"
#include "proto/pictures/picture.h"

namespace lfd {

// Scanlines from the top, channels R, G, B, A of 32-bit float, ZIP compression. Every float survives, infinities and
// NaN included.
Result<std::string> encode_exr(const PictureF& picture);

// Half floats are widened; the data window is the picture. Errors: damaged, a channel of the four is missing or
// subsampled, more than kMaxPicturePixels.
Result<PictureF> decode_exr(std::string_view file);

// Whole files; errors name the path. Missing folders are made, and readers never see half a file.
Status write_exr(const std::filesystem::path& path, const PictureF& picture);
Result<PictureF> read_exr(const std::filesystem::path& path);

}  // namespace lfd
