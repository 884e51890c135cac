// One cluster after the other.
#include "bench/cluster/cluster_bench.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include "base/clock.h"
#include "base/file.h"
#include "base/log.h"
#include "base/temporary_folder.h"
#include "bench/cluster/crowd.h"
#include "bench/common/daemons.h"
#include "bench/common/free_endpoint.h"
#include "bench/common/process_facts.h"
#include "calibration/make.h"
#include "cli/control_client.h"
#include "controller/scene/made/made_scenes.h"
#include "proto/calibration_file.h"
#include "proto/deployment_file.h"

namespace lfd::bench {
namespace {

// For a frame, on a loaded machine: the first one waits for all nodes.
constexpr auto kPatience = std::chrono::minutes(5);
constexpr int kWarmUp = 20;                      // frames: the first ones compile shaders
constexpr auto kRest = std::chrono::seconds(3);  // without frames: what heartbeats and pulses take
// Of frames of many instances. Those of the most take 0.3 s to be drawn; a controller that is woken so seldom takes
// half as long again for the same frame as one that is woken every 10 ms, and only the instances are to differ.
constexpr auto kCrowdInterval = std::chrono::milliseconds(400);
constexpr double kTurn = 0.01;  // of the scene from frame to frame, radians

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[std::clamp<std::size_t>(rank, 1, values.size()) - 1];
}

Status write_files(const TemporaryFolder& folder, const ClusterRow& row, ImageSize image, const std::string& control) {
  LFD_TRY(DisplayCalibration display, make_display("c80", row.modules));
  display.image = image;
  LFD_TRY_STATUS(save_calibration(folder.path() / "display.textproto", display));
  if (row.resting) LFD_TRY_STATUS(write_crowd(folder.path(), *row.resting));
  const std::string scene =
      row.resting ? "file: \"crowd.gltf\"" : fmt::format("made {{ name: \"{}\" seed: 1 }}", row.scene);
  std::string text = fmt::format(
      "name: \"cluster\" display: \"display.textproto\" scene {{ {} }} sink: DISPLAY\n"
      "accept_calibration: true addresses {{ control: \"{}\" }}\n",
      scene, control);
  for (int node = 0; node < row.nodes; ++node) text += fmt::format("node {{ name: \"node-{}\" }}\n", node);
  return write_file(folder.path() / "cluster.textproto", text);
}

Result<proto::Status> ask_status(ControlClient& client) {
  proto::Request request;
  request.mutable_status();
  LFD_TRY(proto::Reply reply, client.ask(request, kPatience));
  return std::move(*reply.mutable_status());
}

Result<proto::Reply> ask_frame(ControlClient& client) {
  proto::Request request;
  request.mutable_frames()->set_count(1);
  return client.ask(request, kPatience);
}

// Turns the scene about its upright axis, a little for each frame, and has the frame drawn and shown before the next:
// the images of a scene at rest would not be sent. Not sooner than after `interval`.
Result<proto::Reply> ask_frames(ControlClient& client, int count, Clock::duration interval = {}) {
  LFD_TRY(const proto::Status status, ask_status(client));
  proto::Request turn;
  *turn.mutable_roi() = status.roi();
  proto::Reply all;
  for (int i = 1; i <= count; ++i) {
    const double half_angle = kTurn * i / 2;
    turn.mutable_roi()->mutable_world_orientation()->set_y(std::sin(half_angle));
    turn.mutable_roi()->mutable_world_orientation()->set_w(std::cos(half_angle));
    const auto next = Clock::now() + interval;
    LFD_TRY_STATUS(client.ask(turn, kPatience));
    LFD_TRY(const proto::Reply reply, ask_frame(client));
    all.MergeFrom(reply);
    std::this_thread::sleep_until(next);
  }
  return all;
}

Result<double> scene_bytes(const TemporaryFolder& folder, const ClusterRow& row) {
  LFD_TRY(const LoadedScene scene,
          row.resting ? load_scene(folder.path() / "crowd.gltf") : scene::make_scene(row.scene, 1));
  double bytes = 0;
  for (const auto& [hash, asset] : scene.data.assets) bytes += static_cast<double>(asset->size());
  return bytes;
}

struct Sample {
  double processor_s = 0;
  std::uint64_t published = 0;
  Clock::time_point at;
};

Result<Sample> sample(ControlClient& client, int controller) {
  LFD_TRY(const proto::Status status, ask_status(client));
  const auto processor = processor_time_s(controller);
  if (!processor) return Error("the controller's processor time cannot be read");
  return Sample{*processor, status.published_bytes(), Clock::now()};
}

double seconds_between(const Sample& a, const Sample& b) { return std::chrono::duration<double>(b.at - a.at).count(); }

void fill(ClusterRow& row, const proto::Reply& frames, const Sample& before, const Sample& after,
          const Sample& rested) {
  const double count = frames.frame_size();
  std::vector<double> shown, swapped;
  double reports = 0, images = 0;
  for (const proto::FrameReport& frame : frames.frame()) {
    shown.push_back(frame.begin_to_shown_ms());
    swapped.push_back(frame.begin_to_swap_ms());
    for (const proto::NodeReport& node : frame.node()) {
      reports += static_cast<double>(node.ByteSizeLong());
      images += static_cast<double>(node.image_bytes());
    }
  }
  row.shown_median_ms = percentile(shown, 0.5);
  row.shown_99_ms = percentile(shown, 0.99);
  row.swap_median_ms = percentile(swapped, 0.5);
  row.swap_99_ms = percentile(swapped, 0.99);
  const double took_s = seconds_between(before, after);
  row.frames_per_s = count / took_s;
  row.at_rest_us = 1e6 * (rested.processor_s - after.processor_s) / seconds_between(after, rested);
  row.controller_us = (1e6 * (after.processor_s - before.processor_s) - row.at_rest_us * took_s) / count;
  row.state_bytes = static_cast<double>(after.published - before.published) / count;
  row.report_bytes = reports / count;
  row.image_bytes = images / count;
}

Result<ClusterRow> measure(ClusterRow row, const ClusterBenchOptions& options, StopSignals& signals) {
  LFD_TRY(const TemporaryFolder folder, TemporaryFolder::make("lfd-cluster"));
  const std::string control = free_endpoint();
  LFD_TRY_STATUS(write_files(folder, row, options.image, control));
  LFD_TRY(row.scene_bytes, scene_bytes(folder, row));
  Daemons daemons(own_folder(), folder.path() / "cluster.textproto", {});
  LFD_TRY(Process* const controller, daemons.start("controller", {.more = {"--idle", "--log-level", "warn"}}));
  LFD_TRY_STATUS(daemons.start("display", {.more = {"--controller", control}}));
  for (int node = 0; node < row.nodes; ++node) LFD_TRY_STATUS(daemons.start(fmt::format("node-{}", node)));
  LFD_TRY(ControlClient client, ControlClient::connect(control));
  LFD_TRY_STATUS(ask_frame(client));  // answered once the scene and all nodes are there
  LFD_TRY_STATUS(ask_frames(client, kWarmUp));
  if (signals.take()) return Error("ended by a signal");
  LFD_TRY(const Sample before, sample(client, controller->id()));
  LFD_TRY(const proto::Reply frames,
          row.resting ? ask_frames(client, options.crowd_frames, kCrowdInterval) : ask_frames(client, options.frames));
  LFD_TRY(const Sample after, sample(client, controller->id()));
  std::this_thread::sleep_for(kRest);
  LFD_TRY(const Sample rested, sample(client, controller->id()));
  fill(row, frames, before, after, rested);
  LFD_TRY_STATUS(client.quit(kPatience));
  return row;
}

}  // namespace

Line ClusterTable::controller_line(int modules) const {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const ClusterRow& row : rows) {
    if (row.modules != modules) continue;
    n += 1;
    x += row.nodes;
    y += row.controller_us;
    xx += row.nodes * row.nodes;
    xy += row.nodes * row.controller_us;
  }
  const double spread = n * xx - x * x;
  if (spread <= 0) return {n > 0 ? y / n : 0, 0};
  const double slope = (n * xy - x * y) / spread;
  return {(y - slope * x) / n, slope};
}

Result<ClusterTable> cluster_bench(const ClusterBenchOptions& options, StopSignals& signals,
                                   const std::function<void(const ClusterRow&)>& progress) {
  ClusterTable table{.options = options, .rows = {}, .by_scene = {}, .by_rest = {}};
  const auto add = [&](std::vector<ClusterRow>& rows, ClusterRow what) -> Status {
    auto row = measure(what, options, signals);
    if (!row) return row.error().within(fmt::format("{} nodes, {} modules, {}", what.nodes, what.modules, what.scene));
    progress(*row);
    rows.push_back(*std::move(row));
    return {};
  };
  for (const int modules : options.modules) {
    for (const int nodes : options.nodes)
      LFD_TRY_STATUS(add(table.rows, {.nodes = nodes, .modules = modules, .scene = options.scenes.front()}));
  }
  const int nodes = options.nodes[options.nodes.size() / 2], modules = options.modules.front();
  for (const std::string& scene : options.scenes) {
    if (options.scenes.size() < 2) break;
    LFD_TRY_STATUS(add(table.by_scene, {.nodes = nodes, .modules = modules, .scene = scene}));
  }
  for (const int resting : options.resting) {
    const std::string scene = fmt::format("{} at rest, {} move", resting, kCrowdMoving);
    LFD_TRY_STATUS(add(table.by_rest, {.nodes = nodes, .modules = modules, .scene = scene, .resting = resting}));
  }
  return table;
}

}  // namespace lfd::bench
