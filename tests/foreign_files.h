// Foreign files that tests read where they are present: known-answer data that is not part of the repository.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace lfd {

// The file under the folder that the environment variable LFD_SHARED names, else under `shared` beside the sources.
inline std::optional<std::filesystem::path> foreign_file(const std::string& name) {
  const char* folder = std::getenv("LFD_SHARED");
  const auto root =
      folder != nullptr ? std::filesystem::path(folder) : std::filesystem::path(LFD_SOURCE_DIR) / ".." / "shared";
  const auto path = root / name;
  return std::filesystem::exists(path) ? std::optional(path) : std::nullopt;
}

}  // namespace lfd

// Skips a test that needs the file; `variable` becomes the path of it.
#define LFD_FOREIGN_FILE(variable, name)                                               \
  const auto lfd_found_##variable = lfd::foreign_file(name);                           \
  if (!lfd_found_##variable) GTEST_SKIP() << (name) << " is not here; see LFD_SHARED"; \
  const std::filesystem::path variable = *lfd_found_##variable
