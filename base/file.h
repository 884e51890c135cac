// Whole files in and out; every error names the path and what the system said.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/result.h"

namespace lfd {

// Reads a regular file of at most `limit_bytes`.
Result<std::string> read_file(const std::filesystem::path& path, std::size_t limit_bytes = std::size_t{1} << 31);

// Writes beside `path`, then renames: a reader sees the old content or the new one, never half. Creates missing
// folders.
Status write_file(const std::filesystem::path& path, std::string_view content);

}  // namespace lfd
