// JPEG files to pixels; the one door of libjpeg.
#pragma once

#include <string_view>

#include "base/result.h"
#include "proto/pictures/picture.h"

namespace lfd {

// Errors: damaged or cut off, more than kMaxPicturePixels, CMYK.
Result<Picture8> decode_jpeg(std::string_view file);

}  // namespace lfd
