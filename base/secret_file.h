// Files for their owner's eyes alone.
#pragma once

#include <filesystem>
#include <string_view>

#include "base/result.h"

namespace lfd {

// Makes a file of mode 0600 in a folder that is there. What exists stays as it is and is an error.
Status create_secret_file(const std::filesystem::path& path, std::string_view content);

// Refuses a file that its group or others may read or write, or that belongs to neither this user nor root.
Status check_secret_file(const std::filesystem::path& path);

// Refuses a file that its group or others may write, or that belongs to neither this user nor root.
Status check_trusted_file(const std::filesystem::path& path);

}  // namespace lfd
