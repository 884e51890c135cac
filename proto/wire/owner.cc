// From an endpoint to a socket's inode, from there to the process that has it open.
#include "proto/wire/owner.h"

#include <charconv>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "base/log.h"

namespace lfd::wire {
namespace {

namespace fs = std::filesystem;

// Lines of /proc/net/tcp: sl local_address rem_address st tx:rx tr:tm->when retrnsmt uid timeout inode. State 0A:
// listening.
void add_tcp_listeners(const char* table, unsigned port, std::vector<std::string>& inodes) {
  std::ifstream lines(table);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    std::string slot, local, remote, state, queues, timer, retransmits, user, timeout, inode;
    fields >> slot >> local >> remote >> state >> queues >> timer >> retransmits >> user >> timeout >> inode;
    const auto colon = local.rfind(':');
    if (state != "0A" || colon == std::string::npos) continue;
    unsigned listens_at = 0;
    std::from_chars(local.data() + colon + 1, local.data() + local.size(), listens_at, 16);
    if (listens_at == port) inodes.push_back(inode);
  }
}

// Lines of /proc/net/unix: num refcount protocol flags type state inode path. Flag 00010000: listening.
void add_unix_listeners(const std::string& path, std::vector<std::string>& inodes) {
  std::ifstream lines("/proc/net/unix");
  std::string line;
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    std::string number, references, protocol, flags, type, state, inode, name;
    fields >> number >> references >> protocol >> flags >> type >> state >> inode >> std::ws;
    std::getline(fields, name);
    if (flags == "00010000" && name == path) inodes.push_back(inode);
  }
}

bool has_open(const fs::path& process, const std::vector<std::string>& inodes) {
  std::error_code failure;
  for (fs::directory_iterator entry(process / "fd", failure), end; !failure && entry != end; entry.increment(failure)) {
    std::error_code gone;
    const std::string target = fs::read_symlink(entry->path(), gone).string();
    if (gone) continue;
    for (const auto& inode : inodes) {
      if (target == fmt::format("socket:[{}]", inode)) return true;
    }
  }
  return false;
}

std::string command_of(const fs::path& process) {
  std::ifstream stream(process / "cmdline", std::ios::binary);
  std::string program;
  std::getline(stream, program, '\0');
  return program.empty() ? "unknown" : fs::path(program).filename().string();
}

}  // namespace

std::optional<Owner> owner_of(const std::string& endpoint) {
  std::vector<std::string> inodes;
  if (endpoint.starts_with("ipc://")) {
    add_unix_listeners(endpoint.substr(6), inodes);
  } else {
    const auto colon = endpoint.rfind(':');
    unsigned port = 0;
    if (colon == std::string::npos) return std::nullopt;
    std::from_chars(endpoint.data() + colon + 1, endpoint.data() + endpoint.size(), port);
    add_tcp_listeners("/proc/net/tcp", port, inodes);
    add_tcp_listeners("/proc/net/tcp6", port, inodes);
  }
  if (inodes.empty()) return std::nullopt;
  std::error_code failure;
  for (fs::directory_iterator entry("/proc", failure), end; !failure && entry != end; entry.increment(failure)) {
    const std::string name = entry->path().filename().string();
    int process = 0;
    const auto [stop, bad] = std::from_chars(name.data(), name.data() + name.size(), process);
    if (bad != std::errc() || stop != name.data() + name.size()) continue;
    if (has_open(entry->path(), inodes)) return Owner{process, command_of(entry->path())};
  }
  return std::nullopt;
}

}  // namespace lfd::wire
