// Pictures of numbers between 0 and 1 in a file: what a bench keeps, so that it can go on where it was ended.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "bench/ao/metrics.h"

namespace lfd::bench {

// Pictures of one size. `key` says what they are of: a file is used only where it is the same.
struct Planes {
  std::string key;
  std::string note;  // kept with them; neither it nor the key has line breaks
  std::vector<Openness> pictures;
};

// 16 bits a pixel: values are rounded to 1/65534, pixels without a surface stay so. Missing folders are made, and
// readers never see half a file.
Status write_planes(const std::filesystem::path& path, const Planes& planes);

// Absent where there is no such file, or one of something else, or a damaged one.
std::optional<Planes> read_planes(const std::filesystem::path& path, const std::string& key);

}  // namespace lfd::bench
