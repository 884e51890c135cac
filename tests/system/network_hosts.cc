// Namespaces by iproute2.
#include "tests/system/network_hosts.h"

#include <unistd.h>

#include <array>
#include <charconv>
#include <filesystem>

#include "base/log.h"
#include "base/process.h"

namespace lfd::harness {
namespace {

constexpr auto kPatience = std::chrono::seconds(10);

std::optional<std::string> find_program(const std::string& name) {
  for (const char* const folder : {"/usr/sbin", "/sbin", "/usr/bin", "/bin"}) {
    const auto path = std::filesystem::path(folder) / name;
    if (std::filesystem::exists(path)) return path.string();
  }
  return std::nullopt;
}

// What the command says.
Result<std::vector<std::string>> said_by(std::vector<std::string> command) {
  const auto program = find_program(command[0]);
  if (!program) return Error(fmt::format("{} is not installed", command[0]));
  const std::string words = fmt::format("{}", fmt::join(command, " "));
  command[0] = *program;
  LFD_TRY(auto process,
          Process::start({.name = words, .command = std::move(command), .on_line = {}, .environment = {}}));
  const auto exit = process->wait(kPatience);
  if (exit && exit->succeeded()) return process->lines();
  return Error(fmt::format("{}: {}", words, fmt::join(process->lines(), "; ")));
}

Status run(std::vector<std::string> command) {
  const auto said = said_by(std::move(command));
  return said ? Status() : Status(said.error());
}

// The number behind `word` in the first line that has one.
std::uint64_t number_behind(const std::string& word, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    const std::size_t at = line.find(word + " ");
    std::uint64_t number = 0;
    if (at == std::string::npos) continue;
    const char* const digits = line.data() + at + word.size() + 1;
    if (std::from_chars(digits, line.data() + line.size(), number).ec == std::errc()) return number;
  }
  return 0;
}

}  // namespace

Result<std::unique_ptr<SecondHost>> SecondHost::make() {
  if (::geteuid() != 0) return Error("network namespaces need root");
  const int number = static_cast<int>(::getpid()) % 16000;
  auto host = std::unique_ptr<SecondHost>(new SecondHost);
  host->name_ = fmt::format("lfd-test-{}", number);
  host->cable_here_ = fmt::format("lfdh{}", number);
  host->cable_there_ = fmt::format("lfdt{}", number);
  const std::string net = fmt::format("10.213.{}.", number % 256);
  const int first = (number / 256) * 4;
  host->here_ = net + std::to_string(first + 1);
  host->there_ = net + std::to_string(first + 2);
  LFD_TRY_STATUS(run({"ip", "netns", "add", host->name_}));
  LFD_TRY_STATUS(run({"ip", "link", "add", host->cable_here_, "type", "veth", "peer", "name", host->cable_there_,
                      "netns", host->name_}));
  LFD_TRY_STATUS(run({"ip", "addr", "add", host->here_ + "/30", "dev", host->cable_here_}));
  LFD_TRY_STATUS(run({"ip", "link", "set", host->cable_here_, "up"}));
  LFD_TRY_STATUS(run({"ip", "-n", host->name_, "addr", "add", host->there_ + "/30", "dev", host->cable_there_}));
  LFD_TRY_STATUS(run({"ip", "-n", host->name_, "link", "set", "lo", "up"}));
  LFD_TRY_STATUS(host->restore());
  return host;
}

SecondHost::~SecondHost() {
  if (const Status gone = run({"ip", "netns", "del", name_}); !gone) log::debug("{}", gone.error().message());
  if (const Status gone = run({"ip", "link", "del", cable_here_}); !gone) log::debug("{}", gone.error().message());
}

std::vector<std::string> SecondHost::prefix() const { return {*find_program("ip"), "netns", "exec", name_}; }

Status SecondHost::cut() { return run({"ip", "-n", name_, "link", "set", cable_there_, "down"}); }
Status SecondHost::restore() { return run({"ip", "-n", name_, "link", "set", cable_there_, "up"}); }

Status SecondHost::lose_packets(int percent) {
  const auto nft = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"ip", "netns", "exec", name_, "nft"});
    return run(std::move(words));
  };
  if (!find_program("nft")) return Error("nftables are not installed");
  LFD_TRY_STATUS(nft({"add", "table", "ip", "lossy"}));
  LFD_TRY_STATUS(nft({"add chain ip lossy in { type filter hook input priority 0; }"}));
  return nft({fmt::format("add rule ip lossy in numgen random mod 100 < {} counter drop", percent)});
}

Status SecondHost::limit_bandwidth(int kbit_s) {
  return run({"tc", "-n", name_, "qdisc", "add", "dev", cable_there_, "root", "tbf", "rate",
              fmt::format("{}kbit", kbit_s), "burst", "16kb", "latency", "200ms"});
}

Result<std::uint64_t> SecondHost::hindered_packets() const {
  LFD_TRY(const auto limit, said_by({"tc", "-n", name_, "-s", "qdisc", "show", "dev", cable_there_}));
  const auto loss = said_by({"ip", "netns", "exec", name_, "nft", "list", "table", "ip", "lossy"});
  return number_behind("overlimits", limit) + (loss ? number_behind("packets", *loss) : 0);
}

Status SecondHost::clear() {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"ip", "netns", "exec", name_, "nft", "delete", "table", "ip", "lossy"},
        std::vector<std::string>{"tc", "-n", name_, "qdisc", "del", "dev", cable_there_, "root"}}) {
    if (const Status cleared = run(words); !cleared) log::debug("{}", cleared.error().message());
  }
  return {};
}

}  // namespace lfd::harness
