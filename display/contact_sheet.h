// All modules of a frame in one picture, in the order of their numbers, row by row.
#pragma once

#include <span>

#include "base/result.h"
#include "proto/pictures/picture.h"

namespace lfd::display {

// Tiles of `tile_width_px` with the images' aspect ratio, averaged in linear light, with thin gray lines between them;
// modules without an image (null) have no tile. Errors: no image at all, images of different sizes, a sheet of absurd
// size.
Result<Picture8> contact_sheet(std::span<const Picture8* const> images, int tile_width_px);

}  // namespace lfd::display
