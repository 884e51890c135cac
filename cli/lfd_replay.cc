// lfd replay: runs a cluster that shows a recording instead of a scene, and ends with it.
#include <iostream>
#include <memory>

#include "base/file.h"
#include "base/log.h"
#include "cli/lfd_commands.h"
#include "proto/frame_files.h"
#include "proto/recording_reader.h"

namespace lfd {
namespace {

constexpr auto kLong = std::chrono::hours(1);         // to wait at a time
constexpr auto kWriteOut = std::chrono::seconds(30);  // for the display to end after the last frame

struct Arguments {
  ClusterOptions cluster;  // its images folder is the output folder
  double speed = 1;
  bool as_fast_as_possible = false;
};

Status await_end(const Arguments& arguments, Cluster& cluster, StopSignals& signals) {
  while (true) {
    cluster.wait(signals, kLong);
    if (const auto signal = signals.take()) return Error(fmt::format("ended by signal {}", *signal));
    if (!cluster.has_ended()) continue;
    LFD_TRY_STATUS(cluster.quit_or_failed(kStopPatience));
    return arguments.cluster.images.empty() ? Status() : cluster.finish(kWriteOut);
  }
}

Status replay(const Arguments& arguments, StopSignals& signals) {
  std::optional<FolderLock> lock;
  if (!arguments.cluster.images.empty()) {
    LFD_TRY_STATUS(make_folder(arguments.cluster.images));
    LFD_TRY(FolderLock taken, FolderLock::take(arguments.cluster.images));
    lock.emplace(std::move(taken));
    LFD_TRY(const int frames, remove_frames(arguments.cluster.images));
    if (frames > 0)
      std::cerr << fmt::format("{}: {} frames of an earlier run are removed\n", arguments.cluster.images.string(),
                               frames);
  }
  LFD_TRY(Cluster cluster, Cluster::start(arguments.cluster, signals));
  const Status done = await_end(arguments, cluster, signals);
  cluster.stop(kStopPatience);
  return done;
}

}  // namespace

void add_replay_command(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      add_command(app, "replay", "Show a recording on a cluster on this machine", exit_code, [arguments] {
        ReplayOptions& wish = arguments->cluster.replay;
        wish.speed = arguments->as_fast_as_possible ? 0 : arguments->speed;
        // What is wrong with the file is said before anything starts, and before earlier frames are removed.
        if (const auto range = parse_frame_range(wish.frames); !wish.frames.empty() && !range)
          return wrong_use(range.error().within("--frames"));
        if (const auto recording = Recording::open(wish.file); !recording) return fail(recording.error());
        return do_with_cluster(arguments->cluster, [&](StopSignals& signals) { return replay(*arguments, signals); });
      });
  ReplayOptions& wish = arguments->cluster.replay;
  command->add_option("FILE", wish.file, "Recording, as `lfd record` writes it")->required();
  command->add_option("DEPLOYMENT", arguments->cluster.deployment, "Deployment file (*.textproto): display and nodes")
      ->required();
  command->add_option("--out", arguments->cluster.images, "Folder for the images of every frame");
  CLI::Option* speed =
      command->add_option("--speed", arguments->speed, "Times the recorded pace")->check(number_within(0.001, 1000));
  speed->capture_default_str();
  command
      ->add_flag("--as-fast-as-possible", arguments->as_fast_as_possible,
                 "As fast as the nodes draw, and every frame whole")
      ->excludes(speed);
  command->add_option("--frames", wish.frames, "These frames alone, by their recorded numbers (default: all)")
      ->type_name("A-B");
  command->add_flag("--any-display", wish.any_display, "Even where it was recorded on another display");
  add_common_cluster_options(*command, arguments->cluster);
  command->footer(
      "Frames keep the numbers that they were recorded with. What the deployment says of scene, region of interest "
      "and\n"
      "rendering is not used. At a pace, frames that the nodes do not draw in time come late, and the deployment's\n"
      "deadline counts; none is left out.");
}

}  // namespace lfd
