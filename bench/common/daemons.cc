// Command lines of daemons.
#include "bench/common/daemons.h"

#include <signal.h>

#include <algorithm>

namespace lfd::bench {
namespace {

constexpr auto kEndPatience = std::chrono::seconds(60);  // after SIGKILL: a loaded machine

}  // namespace

Result<Process*> Daemons::start(const std::string& name, Start how) {
  if (daemons_.contains(name)) kill(name);
  const bool is_node = name != "controller" && name != "display";
  std::vector<std::string> command = std::move(how.prefix);
  command.push_back((programs_ / (is_node ? "lfd-rendernode" : "lfd-" + name)).string());
  command.push_back(deployment_.string());
  const bool says_level = std::ranges::find(how.more, "--log-level") != how.more.end();
  if (name == "controller" && !says_level) command.insert(command.end(), {"--log-level", "debug"});
  if (name == "display" && !shown_.empty()) command.insert(command.end(), {"--out", shown_.string()});
  if (is_node) command.insert(command.end(), {"--name", name});
  command.insert(command.end(), how.more.begin(), how.more.end());
  LFD_TRY(daemons_[name],
          Process::start(
              {.name = name, .command = std::move(command), .on_line = {}, .environment = std::move(how.environment)}));
  return daemons_[name].get();
}

void Daemons::kill(const std::string& name) {
  Process& process = at(name);
  process.signal(SIGKILL);
  process.wait(kEndPatience);
}

}  // namespace lfd::bench
