// mkdtemp.
#include "base/temporary_folder.h"

#include <stdlib.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

#include "base/log.h"

namespace lfd {

Result<TemporaryFolder> TemporaryFolder::make(std::string_view name) {
  std::error_code failure;
  const std::filesystem::path all = std::filesystem::temp_directory_path(failure);
  if (failure) {
    const char* const told = std::getenv("TMPDIR");
    return Error(fmt::format("TMPDIR {}: there is no such folder for temporary files", told != nullptr ? told : ""));
  }
  std::string pattern = (all / name).string() + "-XXXXXX";
  if (::mkdtemp(pattern.data()) == nullptr)
    return Error(fmt::format("{}: no temporary folder can be made: {}", all.string(), std::strerror(errno)));
  return TemporaryFolder(std::filesystem::path(pattern));
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

}  // namespace lfd
