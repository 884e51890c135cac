// A new folder of this process alone, gone with its object.
#pragma once

#include <filesystem>
#include <string_view>
#include <utility>

#include "base/result.h"

namespace lfd {

class TemporaryFolder {
 public:
  // Below the system's folder for such (TMPDIR); its name begins with `name`, and the rest of it cannot be guessed.
  // Error: that folder is missing, or closed to this user.
  static Result<TemporaryFolder> make(std::string_view name);

  TemporaryFolder(TemporaryFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  TemporaryFolder& operator=(TemporaryFolder&&) = delete;
  ~TemporaryFolder();  // with all that is in it

  const std::filesystem::path& path() const { return path_; }

 private:
  explicit TemporaryFolder(std::filesystem::path path) : path_(std::move(path)) {}

  std::filesystem::path path_;  // empty: another object has it
};

}  // namespace lfd
