// OpenEXR files of four float channels in and out; the one door of OpenEXR.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "proto/pictures/picture.h"

namespace lfd {

// Scanlines from the top, channels R, G, B, A of 32-bit float, ZIP compression. Every float survives, infinities and
// NaN included.
Result<std::string> encode_exr(const PictureF& picture);

// Half floats are widened; the data window is the picture. Errors: damaged, a channel of the four is missing or
// subsampled, and what exr_header.h refuses before memory is taken.
Result<PictureF> decode_exr(std::string_view file);

// The names of all channels; sides beyond `most_side` are refused as below.
Result<std::vector<std::string>> exr_channels(std::string_view file, int most_side);

// The same as decode_exr for channels of other names in place of R, G, B, A; an empty name leaves its numbers 0. Sides
// beyond `most_side` are refused before memory is taken.
Result<PictureF> decode_exr_channels(std::string_view file, const std::array<std::string, 4>& names, int most_side);

// Whole files; errors name the path. Missing folders are made, and readers never see half a file.
Status write_exr(const std::filesystem::path& path, const PictureF& picture);
Result<PictureF> read_exr(const std::filesystem::path& path);

}  // namespace lfd
