// Encoded pictures as assets carry them (PNG or JPEG, told apart by their first bytes) to pixels.
#pragma once

#include <string_view>

#include "base/result.h"
#include "proto/pictures/picture.h"

namespace lfd {

// Gray becomes RGB, palettes are resolved, 16 bits become 8, missing alpha is 255. Embedded colour spaces are ignored,
// as glTF asks. Errors: neither PNG nor JPEG, damaged or cut off, more than kMaxPicturePixels, CMYK.
Result<Picture8> decode_picture(std::string_view file);

}  // namespace lfd
