// The daemons of one deployment as child processes that are taken away and started again one by one.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/process.h"
#include "base/result.h"

namespace lfd::bench {

class Daemons {
 public:
  // How one is started, beside what its name says.
  struct Start {
    std::map<std::string, std::string> environment = {};
    std::vector<std::string> prefix = {};  // what the command line begins with
    std::vector<std::string> more = {};    // what it ends with
  };

  // `programs`: the folder of lfd-controller, lfd-rendernode and lfd-display. The display writes its frames to `shown`;
  // empty: to nowhere.
  Daemons(std::filesystem::path programs, std::filesystem::path deployment, std::filesystem::path shown)
      : programs_(std::move(programs)), deployment_(std::move(deployment)), shown_(std::move(shown)) {}

  // Starts "controller", "display" or the node of this name; one that runs under the name is killed first.
  Result<Process*> start(const std::string& name, Start how);
  Result<Process*> start(const std::string& name) { return start(name, {}); }

  // SIGKILL, and the end is waited for.
  void kill(const std::string& name);

  // One that was started, whether it still runs or not.
  Process& at(const std::string& name) { return *daemons_.at(name); }
  const std::filesystem::path& shown() const { return shown_; }

 private:
  std::filesystem::path programs_, deployment_, shown_;
  std::map<std::string, std::unique_ptr<Process>> daemons_;
};

}  // namespace lfd::bench
