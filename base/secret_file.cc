// Modes of files.
#include "base/secret_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/log.h"

namespace lfd {
namespace {

bool write_all(int descriptor, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

// Refuses a file with any of these bits of its mode, and one that belongs to somebody else. `what`: what is wrong with
// such a mode; `remedy`: what mends it.
Status check_file(const std::filesystem::path& path, ::mode_t refused, const char* what, const char* remedy) {
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0)
    return Error(fmt::format("{}: cannot be read: {}", path.string(), std::strerror(errno)));
  if ((info.st_mode & refused) != 0)
    return Error(fmt::format("{}: {} (mode {:04o}); {}", path.string(), what, info.st_mode & 07777, remedy));
  if (info.st_uid == ::geteuid() || info.st_uid == 0) return {};
  return Error(fmt::format("{}: belongs to user {}, neither to this one ({}) nor to root", path.string(), info.st_uid,
                           ::geteuid()));
}

}  // namespace

Status create_secret_file(const std::filesystem::path& path, std::string_view content) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (descriptor < 0) return Error(fmt::format("{}: cannot be made: {}", path.string(), std::strerror(errno)));
  const bool written = write_all(descriptor, content) && ::fsync(descriptor) == 0;
  const int reason = errno;
  ::close(descriptor);
  if (written) return {};
  ::unlink(path.c_str());
  return Error(fmt::format("{}: cannot be written: {}", path.string(), std::strerror(reason)));
}

Status check_secret_file(const std::filesystem::path& path) {
  return check_file(path, 077, "is open to others", "a secret key is its owner's alone: chmod 600");
}

Status check_trusted_file(const std::filesystem::path& path) {
  return check_file(path, 022, "others may write to it", "they could let in whom they like: chmod go-w");
}

}  // namespace lfd
