// Whole files in and out; every error names the path and what the system said.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "base/result.h"

namespace lfd {

// Reads a regular file of at most `limit_bytes`.
Result<std::string> read_file(const std::filesystem::path& path, std::size_t limit_bytes = std::size_t{1} << 31);

// What is known before a file is read: it is missing, no regular file, or closed to this user.
Status check_readable(const std::filesystem::path& path);

// Writes beside a regular file, then renames: a reader sees the old content or the new one, never half. Symbolic links
// are followed. What exists and is no regular file (a device, a pipe) is written to as it is. Errors: as
// check_writable().
Status write_file(const std::filesystem::path& path, std::string_view content);

// What is known before anything is written: the folder is missing or closed to this user, `path` is a folder, or a file
// that may not be written.
Status check_writable(const std::filesystem::path& path);

// Makes a folder with all that leads to it, and tries whether files can be made in it.
Status make_folder(const std::filesystem::path& path);

// One process at a time works in a folder; the lock leaves no file there and ends with the process.
class FolderLock {
 public:
  // Error: another process has it.
  static Result<FolderLock> take(const std::filesystem::path& folder);
  // Waits while another process has it.
  static Result<FolderLock> wait(const std::filesystem::path& folder);

  FolderLock(FolderLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  FolderLock& operator=(FolderLock&&) = delete;
  ~FolderLock();

 private:
  explicit FolderLock(int descriptor) : descriptor_(descriptor) {}
  static Result<FolderLock> lock(const std::filesystem::path& folder, int operation);

  int descriptor_;
};

}  // namespace lfd
