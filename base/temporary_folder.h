// A new folder of this process alone, gone with its object.
#pragma once

#include <filesystem>
#include <string_view>

namespace lfd {

class TemporaryFolder {
 public:
  // Below the system's folder for such; its name begins with `name`, and the rest of it cannot be guessed.
  explicit TemporaryFolder(std::string_view name);
  ~TemporaryFolder();  // with all that is in it
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace lfd
