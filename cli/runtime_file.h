// How `lfd ctl` finds the clusters of this user: `lfd run` leaves a file with its controller's endpoint while it runs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"

namespace lfd {

struct RunningCluster {
  int process = 0;  // of `lfd run`
  std::string endpoint;
  std::string deployment;
  std::string key_file;  // that opens it to who may change the show; empty: it works without keys
};

// ${XDG_RUNTIME_DIR:-/tmp}/lfd-<user id>
std::filesystem::path runtime_folder();

// Makes that folder, which is this user's alone. The error names the variable where it is the reason.
Status make_runtime_folder();

// The file of this process; it is removed with the object.
class RuntimeFile {
 public:
  static Result<RuntimeFile> write(const std::string& endpoint, const std::string& deployment,
                                   const std::string& key_file);
  RuntimeFile(RuntimeFile&& other) noexcept : path_(std::move(other.path_)) { other.path_.clear(); }
  RuntimeFile& operator=(RuntimeFile&&) = delete;
  ~RuntimeFile();

 private:
  explicit RuntimeFile(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;  // empty: moved from
};

// All that run; files of processes that are gone are left out and removed.
std::vector<RunningCluster> running_clusters();

// The only one. Errors: none runs; several do (all are listed).
Result<RunningCluster> only_running_cluster();

}  // namespace lfd
