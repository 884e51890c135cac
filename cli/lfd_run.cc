// lfd run: keeps a cluster running until Ctrl-C.
#include <filesystem>
#include <iostream>
#include <memory>

#include "base/log.h"
#include "cli/lfd_commands.h"
#include "cli/runtime_file.h"

namespace lfd {
namespace {

constexpr auto kLong = std::chrono::hours(1);  // to wait at a time

std::string full_path_of(const std::filesystem::path& path) {
  std::error_code failure;
  return path.empty() ? "" : std::filesystem::absolute(path, failure).string();
}

Status run(const ClusterOptions& options, StopSignals& signals) {
  LFD_TRY_STATUS(make_runtime_folder());
  LFD_TRY(Cluster cluster, Cluster::start(options, signals));
  const std::string full_path = full_path_of(options.deployment);
  LFD_TRY(const RuntimeFile file, RuntimeFile::write(cluster.endpoint(), full_path, full_path_of(cluster.key_file())));
  std::cout << fmt::format("running {}: control {}\n", options.deployment.string(), cluster.endpoint()) << std::flush;
  while (true) {
    cluster.wait(signals, kLong);
    if (const auto signal = signals.take()) {
      log::info("signal {}: all processes are ended", *signal);
      cluster.stop(kStopPatience);
      return {};
    }
    if (cluster.has_ended()) {
      const Status done = cluster.quit_or_failed(kStopPatience);
      cluster.stop(kStopPatience);
      return done;
    }
  }
}

}  // namespace

void add_run_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ClusterOptions>();
  CLI::App* command = add_command(app, "run", "Run a whole cluster on this machine until Ctrl-C", exit_code, [options] {
    return do_with_cluster(*options, [&](StopSignals& signals) { return run(*options, signals); });
  });
  add_cluster_options(*command, *options);
}

}  // namespace lfd
