// A scene of many small triangles at rest among which a few move: what a frame costs the controller must not depend on
// how many rest.
#pragma once

#include <filesystem>

#include "base/result.h"

namespace lfd::bench {

inline constexpr int kCrowdMoving = 4;

// Writes a glTF file with its buffer into the folder and returns its path. Each triangle is an instance of one mesh;
// kCrowdMoving more of them go to and fro in two seconds.
Result<std::filesystem::path> write_crowd(const std::filesystem::path& folder, int resting);

}  // namespace lfd::bench
