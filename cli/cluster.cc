// Starting and ending the processes of a cluster.
#include "cli/cluster.h"

#include <poll.h>
#include <signal.h>

#include <algorithm>
#include <iostream>
#include <mutex>

#include "base/log.h"
#include "proto/deployment_keys.h"
#include "proto/key_files.h"
#include "proto/module_ranges.h"

namespace lfd {
namespace {

constexpr std::string_view kEndpointLine = "lfd-controller: control ";
constexpr auto kBindPatience = std::chrono::seconds(10);
constexpr auto kLook = std::chrono::milliseconds(100);  // between looks at signals

void print_line(const std::string& name, std::string_view line) {
  if (line.starts_with(kErrorMark)) return;
  static std::mutex one_at_a_time;  // children are heard on threads of their own
  const std::lock_guard lock(one_at_a_time);
  std::cerr << name << " | " << line << std::endl;
}

void add_option(std::vector<std::string>& command, const char* option, const std::string& value) {
  if (!value.empty()) command.insert(command.end(), {option, value});
}

std::string program(const char* name) { return (own_folder() / name).string(); }

std::vector<std::string> controller_command(const ClusterOptions& options) {
  std::vector<std::string> command{program("lfd-controller"), options.deployment, "--print-endpoint"};
  add_option(command, "--scene", options.scene);
  add_option(command, "--display", options.display);
  if (!options.roi.empty())
    command.push_back(fmt::format("--roi={}", fmt::join(options.roi, ",")));  // it may begin with a minus
  add_option(command, "--plan", options.plan);
  add_option(command, "--only-modules", fmt::format("{}", fmt::join(options.modules, ",")));
  add_option(command, "--log-level", options.log_level);
  if (!options.images.empty()) add_option(command, "--sink", "display");
  if (options.no_ao) command.push_back("--no-ao");
  if (options.accept_calibration) command.push_back("--accept-calibration");
  if (options.idle) command.push_back("--idle");
  if (const ReplayOptions& replay = options.replay; !replay.file.empty()) {
    add_option(command, "--replay", replay.file.string());
    add_option(command, "--replay-speed", fmt::format("{}", replay.speed));
    add_option(command, "--replay-frames", replay.frames);
    if (replay.any_display) command.push_back("--replay-any-display");
  }
  return command;
}

// "node left: exit code 1: why".
std::string end_of(const Process& process, const Exit& exit) {
  if (exit.succeeded()) return fmt::format("{}: has ended, though the cluster was not asked to", process.name());
  return fmt::format("{}: {}: {}", process.name(), exit.text(), last_words(process));
}

}  // namespace

std::string last_words(const Process& process) {
  const std::vector<std::string> lines = process.lines();
  const auto error =
      std::find_if(lines.rbegin(), lines.rend(), [](const std::string& line) { return line.starts_with(kErrorMark); });
  return error != lines.rend() ? error->substr(kErrorMark.size()) : "it said no more";
}

Result<Deployment> load_deployment(const ClusterOptions& options) {
  DeploymentOverrides overrides;
  if (!options.scene.empty()) overrides.scene = options.scene;
  if (!options.display.empty()) overrides.display = options.display;
  return load_deployment(options.deployment, overrides);
}

Result<std::set<int>> wanted_modules(const ClusterOptions& options, const Deployment& deployment) {
  const std::vector<int> unowned = unowned_modules(deployment);
  std::set<int> wanted;
  for (const std::string& text : options.modules) {
    auto range = parse_module_range(text, static_cast<int>(deployment.display.modules.size()));
    if (!range) return range.error().within("--module");
    for (const int module : *range) {
      if (std::ranges::binary_search(unowned, module))
        return Error(fmt::format("--module: {}: no node of the deployment draws it", module));
      wanted.insert(module);
    }
  }
  return wanted;
}

Status Cluster::add(const ClusterOptions& options, const std::string& name, std::vector<std::string> command) {
  Process::Options process{.name = name, .command = std::move(command), .on_line = {}, .environment = {}};
  if (!options.quiet) process.on_line = [name](std::string_view line) { print_line(name, line); };
  LFD_TRY(auto started, Process::start(std::move(process)));
  processes_.push_back(std::move(started));
  return {};
}

Result<Cluster> Cluster::start(const ClusterOptions& options, StopSignals& signals) {
  Cluster cluster;
  LFD_TRY(cluster.deployment_, load_deployment(options));
  if (const auto keys = keys_folder(cluster.deployment_)) {
    LFD_TRY(const std::filesystem::path key, find_operator_key(*keys));
    cluster.key_file_ = key.string();
  }
  LFD_TRY(const std::set<int> wanted, wanted_modules(options, cluster.deployment_));

  LFD_TRY_STATUS(cluster.add(options, "controller", controller_command(options)));
  Process& controller = *cluster.processes_.front();
  std::optional<std::string> line;
  const auto deadline = Clock::now() + kBindPatience;
  while (!line && !controller.poll() && Clock::now() < deadline) {
    line = controller.wait_for_line(kEndpointLine, kLook);
    if (line || !signals.take()) continue;
    controller.stop(kStopPatience);
    return Error("ended by a signal before the controller was there");
  }
  if (!line) {
    controller.stop(kStopPatience);
    return Error(last_words(controller)).within("controller");
  }
  cluster.endpoint_ = line->substr(kEndpointLine.size());

  if (!options.images.empty() || cluster.deployment_.message.sink() == proto::Deployment::DISPLAY) {
    std::vector<std::string> command{program("lfd-display"), options.deployment, "--controller", cluster.endpoint_};
    add_option(command, "--display", options.display);
    add_option(command, "--out", options.images);
    add_option(command, "--log-level", options.log_level);
    LFD_TRY_STATUS(cluster.add(options, "display", std::move(command)));
  }
  for (const NodeShare& node : cluster.deployment_.nodes) {
    const std::size_t before = cluster.modules_.size();
    std::ranges::copy_if(node.modules, std::back_inserter(cluster.modules_),
                         [&](int module) { return options.modules.empty() || wanted.contains(module); });
    if (cluster.modules_.size() == before && !node.spare) continue;  // it has nothing to draw
    std::vector<std::string> command{program("lfd-rendernode"), options.deployment, "--name", node.name, "--controller",
                                     cluster.endpoint_};
    add_option(command, "--display", options.display);
    add_option(command, "--log-level", options.log_level);
    LFD_TRY_STATUS(cluster.add(options, "node " + node.name, std::move(command)));
  }
  std::ranges::sort(cluster.modules_);
  return cluster;
}

void Cluster::wait(const StopSignals& signals, Clock::duration at_most) const {
  std::vector<pollfd> descriptors{{.fd = signals.descriptor(), .events = POLLIN, .revents = 0}};
  for (const auto& process : processes_) {
    descriptors.push_back({.fd = process->ended_descriptor(), .events = POLLIN, .revents = 0});
  }
  const auto patience = std::chrono::ceil<std::chrono::milliseconds>(at_most).count();
  ::poll(descriptors.data(), descriptors.size(), static_cast<int>(patience));
}

bool Cluster::has_ended() {
  return std::ranges::any_of(processes_, [](const auto& process) { return process->poll().has_value(); });
}

Status Cluster::finish(Clock::duration at_most) {
  const auto deadline = Clock::now() + at_most;
  for (const auto& process : processes_) {
    const auto exit = process->wait(deadline - Clock::now());
    if (!exit) return Error("does not end").within(process->name());
    if (!exit->succeeded()) return Error(end_of(*process, *exit));
  }
  return {};
}

Status Cluster::quit_or_failed(Clock::duration at_most) {
  const auto failure = [&](bool any_end) -> Status {
    for (const auto& process : processes_) {
      const auto exit = process->poll();
      if (exit && (any_end || !exit->succeeded())) return Error(end_of(*process, *exit));
    }
    return {};
  };
  LFD_TRY_STATUS(failure(false));
  // The controller tells the others to end, and goes when its last words have left: perhaps after them.
  const bool controller_ended = processes_.front()->wait(at_most).has_value();
  return failure(!controller_ended);
}

void Cluster::stop(Clock::duration patience) {
  const auto deadline = Clock::now() + patience;
  for (const auto& process : processes_) {
    if (!process->poll()) process->signal(SIGTERM);
  }
  for (const auto& process : processes_) {
    if (!process->wait(std::max(deadline - Clock::now(), Clock::duration::zero()))) {
      log::warn("{}: did not end in time; it is killed", process->name());
      process->signal(SIGKILL);
    }
  }
}

}  // namespace lfd
