// Whole files in and out.
#include "base/file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "base/log.h"

namespace lfd {
namespace fs = std::filesystem;

Result<std::string> read_file(const fs::path& path, std::size_t limit_bytes) {
  std::error_code failure;
  const auto status = fs::status(path, failure);
  if (!fs::exists(status)) return Error(fmt::format("{}: no such file", path.string()));
  if (!fs::is_regular_file(status)) return Error(fmt::format("{}: not a regular file", path.string()));
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

Status write_file(const fs::path& path, std::string_view content) {
  std::error_code failure;
  if (path.has_parent_path()) fs::create_directories(path.parent_path(), failure);
  if (failure) return Error(fmt::format("{}: {}", path.parent_path().string(), failure.message()));
  fs::path beside = path;
  beside += fmt::format(".{}.part", ::getpid());
  {
    std::ofstream stream(beside, std::ios::binary | std::ios::trunc);
    stream.write(content.data(), static_cast<std::streamsize>(content.size()));
    stream.close();
    if (!stream) {
      const std::string reason = std::strerror(errno);
      fs::remove(beside, failure);
      return Error(fmt::format("{}: cannot be written: {}", path.string(), reason));
    }
  }
  fs::rename(beside, path, failure);
  if (failure) return Error(fmt::format("{}: {}", path.string(), failure.message()));
  return {};
}

}  // namespace lfd
