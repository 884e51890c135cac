// Whole files in and out.
#include "base/file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "base/log.h"

namespace lfd {
namespace fs = std::filesystem;
namespace {

constexpr int kMostLinks = 40;  // as the kernel follows

Error cannot_write(const fs::path& path) {
  return Error(fmt::format("{}: cannot be written: {}", path.string(), std::strerror(errno)));
}

bool may(const fs::path& path, int what) { return ::faccessat(AT_FDCWD, path.c_str(), what, AT_EACCESS) == 0; }

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

// The file that `path` leads to; one behind a link need not exist yet. What exists and is no regular file stays as it
// is: the links of /proc name no path.
Result<fs::path> followed(fs::path path) {
  std::error_code failure;
  const fs::path asked = path;
  for (int links = 0; links < kMostLinks; ++links) {
    const auto status = fs::status(path, failure);
    const bool special = fs::exists(status) && !fs::is_regular_file(status);
    if (special || !fs::is_symlink(fs::symlink_status(path, failure))) return path;
    path = folder_of(path) / fs::read_symlink(path, failure);
  }
  return Error(fmt::format("{}: too many symbolic links", asked.string()));
}

// False where something could not be written; errno says why.
bool write_stream(const fs::path& path, std::string_view content) {
  std::ofstream stream(path, std::ios::binary | std::ios::trunc);
  stream.write(content.data(), static_cast<std::streamsize>(content.size()));
  stream.close();
  return static_cast<bool>(stream);
}

}  // namespace

Status check_readable(const fs::path& path) {
  std::error_code failure;
  const auto status = fs::status(path, failure);
  if (!fs::exists(status)) return Error(fmt::format("{}: no such file", path.string()));
  if (!fs::is_regular_file(status)) return Error(fmt::format("{}: not a regular file", path.string()));
  if (!may(path, R_OK)) return Error(fmt::format("{}: cannot be read: {}", path.string(), std::strerror(errno)));
  return {};
}

Result<std::string> read_file(const fs::path& path, std::size_t limit_bytes) {
  LFD_TRY_STATUS(check_readable(path));
  std::error_code failure;
  const auto size = fs::file_size(path, failure);
  if (failure) return Error(fmt::format("{}: {}", path.string(), failure.message()));
  if (size > limit_bytes)
    return Error(fmt::format("{}: {} bytes; at most {} are read", path.string(), size, limit_bytes));
  std::ifstream stream(path, std::ios::binary);
  std::string content(size, '\0');
  if (!stream.read(content.data(), static_cast<std::streamsize>(size))) {
    return Error(fmt::format("{}: cannot be read: {}", path.string(), std::strerror(errno)));
  }
  return content;
}

Status check_writable(const fs::path& path) {
  LFD_TRY(const fs::path target, followed(path));
  std::error_code failure;
  const auto status = fs::status(target, failure);
  if (fs::is_directory(status)) return Error(fmt::format("{}: is a folder", path.string()));
  if (fs::exists(status) && !may(target, W_OK)) return cannot_write(path);
  if (fs::exists(status) && !fs::is_regular_file(status)) return {};
  const fs::path folder = folder_of(target);
  if (!fs::is_directory(folder, failure))
    return Error(fmt::format("{}: there is no folder {}", path.string(), folder.string()));
  if (!may(folder, W_OK | X_OK)) return cannot_write(folder);
  return {};
}

Status write_file(const fs::path& path, std::string_view content) {
  LFD_TRY_STATUS(check_writable(path));
  LFD_TRY(const fs::path target, followed(path));
  std::error_code failure;
  const auto status = fs::status(target, failure);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    return write_stream(target, content) ? Status() : Status(cannot_write(path));
  }
  fs::path beside = target;
  beside += fmt::format(".{}.part", ::getpid());
  if (!write_stream(beside, content)) {
    const Error error = cannot_write(path);
    fs::remove(beside, failure);
    return error;
  }
  if (fs::exists(status)) fs::permissions(beside, status.permissions(), failure);
  fs::rename(beside, target, failure);
  if (failure) return Error(fmt::format("{}: {}", path.string(), failure.message()));
  return {};
}

Status make_folder(const fs::path& path) {
  std::error_code failure;
  fs::create_directories(path, failure);
  if (failure) return Error(fmt::format("{}: cannot be made: {}", path.string(), failure.message()));
  if (!may(path, W_OK | X_OK)) return cannot_write(path);
  return {};
}

Result<FolderLock> FolderLock::take(const fs::path& folder) { return lock(folder, LOCK_EX | LOCK_NB); }

Result<FolderLock> FolderLock::wait(const fs::path& folder) { return lock(folder, LOCK_EX); }

Result<FolderLock> FolderLock::lock(const fs::path& folder, int operation) {
  FolderLock lock(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (lock.descriptor_ < 0) return Error(fmt::format("{}: {}", folder.string(), std::strerror(errno)));
  int failed = 0;
  do failed = ::flock(lock.descriptor_, operation);
  while (failed != 0 && errno == EINTR);
  if (failed == 0) return lock;
  if (errno == EWOULDBLOCK) return Error(fmt::format("{}: another process writes there", folder.string()));
  return Error(fmt::format("{}: cannot be locked: {}", folder.string(), std::strerror(errno)));
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace lfd
