// Written frames: reading their colour images back.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "base/result.h"
#include "proto/pictures/picture.h"

namespace lfd::display {

// The colour images of one frame's folder by module number; as many as `modules`, or up to the last one there where it
// is 0. Modules without a file are absent. Errors: not a folder, no colour image in it, a file that cannot be read.
Result<std::vector<std::optional<Picture8>>> read_color_images(const std::filesystem::path& frame_folder,
                                                               int modules = 0);

// Pointers to what is there, null elsewhere; valid as long as `pictures`.
std::vector<const Picture8*> pointers_to(const std::vector<std::optional<Picture8>>& pictures);

}  // namespace lfd::display
