// The files of running clusters.
#include "cli/runtime_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <sstream>

#include "base/file.h"
#include "base/log.h"

namespace lfd {
namespace fs = std::filesystem;
namespace {

constexpr const char* kFolderWithout = "/tmp";  // without XDG_RUNTIME_DIR
constexpr std::string_view kExtension = ".endpoint";

// A file outlives a process that was killed, and process ids are used again: only a process of this program counts.
bool runs(int process) {
  std::error_code failure;
  const fs::path theirs = fs::read_symlink(fmt::format("/proc/{}/exe", process), failure);
  return !failure && theirs.filename().string().starts_with("lfd");
}

// A folder that others can write to could be used to send commands elsewhere.
Status own_folder_only(const fs::path& folder) {
  struct stat info {};
  if (::lstat(folder.c_str(), &info) != 0) return Error(fmt::format("{}: cannot be made", folder.string()));
  if (!S_ISDIR(info.st_mode) || info.st_uid != ::getuid()) {
    return Error(fmt::format("{}: is not a folder of this user", folder.string()));
  }
  if ((info.st_mode & 022) != 0) return Error(fmt::format("{}: others may write to it: chmod go-w", folder.string()));
  return {};
}

std::optional<RunningCluster> read_entry(const fs::path& path) {
  const std::string stem = path.stem().string();
  RunningCluster cluster;
  const auto [end, failure] = std::from_chars(stem.data(), stem.data() + stem.size(), cluster.process);
  if (failure != std::errc() || end != stem.data() + stem.size()) return std::nullopt;
  if (!runs(cluster.process)) {
    std::error_code ignored;
    fs::remove(path, ignored);
    return std::nullopt;
  }
  const auto text = read_file(path, 1 << 16);
  if (!text) return std::nullopt;
  std::istringstream lines(*text);
  std::getline(lines, cluster.endpoint);
  std::getline(lines, cluster.deployment);
  std::getline(lines, cluster.key_file);
  return cluster;
}

}  // namespace

fs::path runtime_folder() {
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  const fs::path base = runtime != nullptr && *runtime != '\0' ? runtime : kFolderWithout;
  return base / fmt::format("lfd-{}", ::getuid());
}

Status make_runtime_folder() {
  const fs::path folder = runtime_folder();
  const int made = ::mkdir(folder.c_str(), 0700);
  const std::string reason = std::strerror(errno);
  Status usable = own_folder_only(folder);
  if (made != 0 && !fs::exists(folder)) usable = Error(fmt::format("{}: cannot be made: {}", folder.string(), reason));
  if (usable || folder.parent_path() == kFolderWithout) return usable;
  return usable.error().within("XDG_RUNTIME_DIR");
}

Result<RuntimeFile> RuntimeFile::write(const std::string& endpoint, const std::string& deployment,
                                       const std::string& key_file) {
  const fs::path path = runtime_folder() / fmt::format("{}{}", ::getpid(), kExtension);
  LFD_TRY_STATUS(write_file(path, endpoint + "\n" + deployment + "\n" + key_file + "\n"));
  return RuntimeFile(path);
}

RuntimeFile::~RuntimeFile() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove(path_, ignored);
}

std::vector<RunningCluster> running_clusters() {
  std::vector<RunningCluster> clusters;
  std::error_code failure;
  if (!own_folder_only(runtime_folder())) return clusters;
  for (const fs::directory_entry& entry : fs::directory_iterator(runtime_folder(), failure)) {
    if (entry.path().extension() != kExtension) continue;
    if (auto cluster = read_entry(entry.path())) clusters.push_back(*std::move(cluster));
  }
  return clusters;
}

Result<RunningCluster> only_running_cluster() {
  const std::vector<RunningCluster> clusters = running_clusters();
  if (clusters.empty()) return Error("no cluster runs (start one with `lfd run`, or name it with --controller)");
  if (clusters.size() == 1) return clusters.front();
  std::string list;
  for (const RunningCluster& one : clusters) {
    list += fmt::format("\n  --controller {}  (process {}, {})", one.endpoint, one.process, one.deployment);
  }
  return Error("several clusters run; name one:" + list);
}

}  // namespace lfd
