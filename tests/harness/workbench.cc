// Folders, deployments and processes of tests.
#include "tests/harness/workbench.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <charconv>
#include <fstream>
#include <map>

#include "base/file.h"
#include "base/log.h"
#include "proto/calibration_file.h"

namespace lfd::harness {
namespace fs = std::filesystem;
namespace {

constexpr auto kStartPatience = std::chrono::seconds(20);

DisplayCalibration small_display(ImageSize image) {
  DisplayCalibration display;
  display.name = "small";
  display.screen = {1.6, 0.9};
  display.image = image;
  display.optics.diffuser = Diffuser::kLinear;
  display.optics.observer_height_m = 0;
  display.optics.observer_distance_m = 2;
  display.angular_scattering_rad = 0.4;
  for (int k = 0; k < 4; ++k) display.modules.push_back({Emitter{-0.6 + 0.4 * k, 0, -1}, IdealMap{}});
  return display;
}

// State and parent as /proc/ID/stat has them: "S 1 ..."; empty where there is no such process.
std::string stat_of(int process) {
  std::ifstream stat(fmt::format("/proc/{}/stat", process));
  const std::string text((std::istreambuf_iterator<char>(stat)), {});
  const std::size_t name_end = text.rfind(')');  // the name may contain anything
  return name_end == std::string::npos || name_end + 4 >= text.size() ? "" : text.substr(name_end + 2);
}

int parent_of(int process) {
  const std::string stat = stat_of(process);
  int parent = 0;
  if (!stat.empty()) std::from_chars(stat.data() + 2, stat.data() + stat.size(), parent);
  return parent;
}

}  // namespace

Workbench::Workbench(ImageSize image) {
  const Status saved = save_calibration(folder() / "display.textproto", small_display(image));
  LFD_CHECK(saved, saved.error().message());
}

std::string Workbench::display_hash(ImageSize image) { return calibration_hash(small_display(image)); }

fs::path Workbench::file(const std::string& name, const std::string& content) const {
  const Status written = write_file(folder() / name, content);
  LFD_CHECK(written, written.error().message());
  return folder() / name;
}

fs::path Workbench::deployment(const std::string& more, const std::string& name) const {
  return file(name,
              "name: \"wall\"\ndisplay: \"display.textproto\"\nscene { made { name: \"plane\" seed: 1 } }\n"
              "node { name: \"left\" }\nnode { name: \"right\" }\n" +
                  more);
}

std::unique_ptr<Process> start_program(const std::string& program, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), (fs::path(LFD_BIN_DIR) / program).string());
  auto process = Process::start({.name = program, .command = std::move(arguments), .on_line = {}, .environment = {}});
  LFD_CHECK(process, process.error().message());
  return *std::move(process);
}

RunningController start_controller(const fs::path& deployment, std::vector<std::string> more) {
  more.insert(more.begin(), {deployment.string(), "--print-endpoint", "--log-level", "debug"});
  auto process = start_program("lfd-controller", std::move(more));
  const std::string mark = "lfd-controller: control ";
  const auto line = process->wait_for_line(mark, kStartPatience);
  LFD_CHECK(line, fmt::format("{}", fmt::join(process->lines(), "\n")));
  return {std::move(process), line->substr(mark.size())};
}

std::vector<int> descendants_named(const std::string& name) {
  std::map<int, int> parents;
  for (const fs::directory_entry& entry : fs::directory_iterator("/proc")) {
    const std::string id = entry.path().filename().string();
    int process = 0;
    const auto [end, failure] = std::from_chars(id.data(), id.data() + id.size(), process);
    if (failure == std::errc() && end == id.data() + id.size()) parents[process] = parent_of(process);
  }
  std::vector<int> found;
  for (const auto& [process, parent] : parents) {
    int ancestor = process;
    while (ancestor > 1 && ancestor != ::getpid()) ancestor = parents.contains(ancestor) ? parents.at(ancestor) : 0;
    std::ifstream comm(fmt::format("/proc/{}/comm", process));
    std::string command;
    std::getline(comm, command);
    if (runs(process) && ancestor == ::getpid() && process != ::getpid() && command.starts_with(name))
      found.push_back(process);
  }
  return found;
}

bool runs(int process) {
  const std::string stat = stat_of(process);
  return !stat.empty() && stat.front() != 'Z';
}

int free_port() {
  const int descriptor = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = ::htonl(INADDR_LOOPBACK);
  socklen_t length = sizeof address;
  LFD_CHECK(::bind(descriptor, reinterpret_cast<sockaddr*>(&address), length) == 0, "some port is free");
  ::getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &length);
  ::close(descriptor);
  return ::ntohs(address.sin_port);
}

}  // namespace lfd::harness
