// What an OpenEXR file asks memory for, read from its header before OpenEXR takes any.
//
// OpenEXR makes its buffers as wide as the header says while it opens a file: 2 GB for 400 bytes.
#pragma once

#include <string_view>

#include "base/result.h"

namespace lfd {

inline constexpr int kMostExrChannels = 64;

// Refuses what is not one picture of scanlines, sides of the data window beyond `most_side` or more than
// kMaxPicturePixels in all, more than kMostExrChannels channels, and attributes longer than the file. What OpenEXR then
// takes to open and read the file is at most 256 lines of all channels, beside the picture.
// Source: OpenEXR file layout, https://openexr.com/en/latest/OpenEXRFileLayout.html.
Status check_exr_header(std::string_view file, int most_side);

}  // namespace lfd
