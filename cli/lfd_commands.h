// The subcommands of `lfd`, and the options that several of them share.
#pragma once

#include "base/command_line.h"
#include "cli/cluster.h"
#include "cli/ctl_requests.h"
#include "proto/wire.pb.h"

namespace lfd {

// run, render and view end what they started when a signal comes; ctl and bench just end.
void add_run_command(CLI::App& app, int& exit_code);
void add_render_command(CLI::App& app, int& exit_code);
void add_record_command(CLI::App& app, int& exit_code);
void add_replay_command(CLI::App& app, int& exit_code);
void add_view_command(CLI::App& app, int& exit_code);
void add_ctl_command(CLI::App& app, int& exit_code);
void add_keys_command(CLI::App& app, int& exit_code);
void add_bench_command(CLI::App& app, int& exit_code);

// One of the boxes of a region of interest as CX,CY,CZ,SX,SY,SZ: centre and edge lengths. What no region of interest
// can have is wrong use.
enum class Box { kWorld, kPhysical };
CLI::Option* add_box(CLI::App& app, const std::string& name, std::vector<double>& numbers, Box box,
                     const std::string& description);

// DEPLOYMENT, --scene, --display, --roi, --plan, --no-ao, --accept-calibration, --module, --log-level.
void add_cluster_options(CLI::App& command, ClusterOptions& options);

// Of these: --display, --accept-calibration, --module, --log-level.
void add_common_cluster_options(CLI::App& command, ClusterOptions& options);

// --controller: where a running one listens; left empty: the only one that `lfd run` runs here.
void add_controller_options(CLI::App& command, ControllerAt& controller);

// Does what needs a cluster, and answers the exit code. What the options ask and cannot be is found before anything
// starts: kExitWrongUse.
int do_with_cluster(const ClusterOptions& options, const std::function<Status(StopSignals& signals)>& what);

struct RenderOptions {
  ClusterOptions cluster;  // its images folder is the output folder
  std::uint32_t frames = 1;
  std::uint32_t buffers = 0;  // bit i: buffer kind i beside colour
  bool time_modules = false;
};

// Starts a cluster, has it draw frames into the output folder in place of those of an earlier render, writes
// report.json there, and ends the cluster. Errors: whatever failed; images that are missing; a signal; another render
// into the folder.
Status render(const RenderOptions& options, StopSignals& signals);

// "color,position,..." as the bits of RenderOptions::buffers. Errors name the one that is unknown and what was meant.
Result<std::uint32_t> parse_buffers(const std::vector<std::string>& names);

}  // namespace lfd
