// lfd render: draws frames into files, reports, and leaves.
#include <algorithm>
#include <functional>
#include <iostream>
#include <iterator>
#include <memory>

#include "base/file.h"
#include "base/log.h"
#include "cli/control_client.h"
#include "cli/lfd_commands.h"
#include "cli/report.h"
#include "proto/frame_files.h"
#include "proto/module_ranges.h"

namespace lfd {
namespace {

constexpr auto kAnswerPatience = std::chrono::seconds(10);
constexpr auto kLook = std::chrono::milliseconds(100);  // between looks at signals and children
constexpr auto kProgress = std::chrono::seconds(2);     // between lines of progress
constexpr auto kWriteOut = std::chrono::seconds(30);    // for the display to end after the last frame

// How many frames are asked for at a time: their reports come in one message, which holds about a thousand module
// reports per MiB.
constexpr std::uint32_t kModuleReportsPerRequest = 32000;

// Lines of progress on standard error, from time to time and where they say something new.
class Progress {
 public:
  bool is_due() const { return Clock::now() >= next_; }

  void show(const std::string& line) {
    next_ = Clock::now() + kProgress;
    if (line != last_) std::cerr << line << std::endl;
    last_ = line;
  }

 private:
  Clock::time_point next_ = Clock::now() + kProgress;
  std::string last_;
};

std::string frames_text(std::uint32_t count) { return fmt::format("{} frame{}", count, count == 1 ? "" : "s"); }

proto::Request frames_request(const RenderOptions& options, std::uint32_t count) {
  proto::Request request;
  request.mutable_frames()->set_count(count);
  request.mutable_frames()->set_buffers(options.buffers);
  request.mutable_frames()->set_time_modules(options.time_modules);
  return request;
}

Result<proto::Status> ask_status(ControlClient& client) {
  proto::Request request;
  request.mutable_status();
  LFD_TRY(const proto::Reply reply, client.ask(request, kAnswerPatience));
  return reply.status();
}

std::string progress(const proto::Status& status, std::uint32_t frames) {
  std::string waiting;
  for (const proto::PeerStatus& peer : status.peer()) {
    if (peer.state() != "ready" && peer.module_size() > 0)
      waiting += fmt::format(" {} ({})", peer.name(), peer.state());
  }
  if (!waiting.empty()) return "waiting for:" + waiting;
  return fmt::format("frame {} of {}", status.frame(), frames);
}

// Why there is nothing to wait for any more, if so.
Status still_running(Cluster& cluster, StopSignals& signals) {
  if (const auto signal = signals.take()) return Error(fmt::format("ended by signal {}", *signal));
  if (!cluster.has_ended()) return {};
  LFD_TRY_STATUS(cluster.quit_or_failed(kStopPatience));
  return Error("the controller was asked to end before the frames were drawn");
}

// Sends the request once the controller is there, while it watches the children and the signals; its number.
Result<std::uint64_t> send_request(const proto::Request& request, Cluster& cluster, ControlClient& client,
                                   StopSignals& signals) {
  const auto deadline = Clock::now() + kAnswerPatience;
  while (true) {
    const auto id = client.send(request, kLook);
    if (id || Clock::now() >= deadline) return id;
    LFD_TRY_STATUS(still_running(cluster, signals));
  }
}

// Waits for the reply to a request, while it watches the children and the signals; `look` is called all the time.
Result<proto::Reply> await_reply(const proto::Request& request, Cluster& cluster, ControlClient& client,
                                 StopSignals& signals, const std::function<void()>& look) {
  LFD_TRY(const std::uint64_t id, send_request(request, cluster, client, signals));
  while (true) {
    if (auto reply = client.receive(id, kLook)) {
      if (!reply->error().empty()) return Error(reply->error());
      return *std::move(reply);
    }
    LFD_TRY_STATUS(still_running(cluster, signals));
    look();
  }
}

// Until the controller has loaded its scene. Errors: it cannot.
Status await_scene(Cluster& cluster, ControlClient& client, StopSignals& signals) {
  Progress shown;
  proto::Request request;
  request.mutable_status();
  while (true) {
    LFD_TRY(const proto::Reply reply, await_reply(request, cluster, client, signals, [] {}));
    if (reply.status().sequence() > 0) return {};
    if (shown.is_due()) shown.show("the scene is being loaded");
    cluster.wait(signals, kLook);
    LFD_TRY_STATUS(still_running(cluster, signals));
  }
}

Result<proto::Reply> await_frames(const RenderOptions& options, std::uint32_t count, Cluster& cluster,
                                  ControlClient& client, ControlClient& watcher, StopSignals& signals) {
  Progress shown;
  return await_reply(frames_request(options, count), cluster, client, signals, [&] {
    if (!shown.is_due()) return;
    const auto status = ask_status(watcher);
    if (status) shown.show(progress(*status, options.frames));  // a child that ended is seen in the next round
  });
}

// Takes away what an earlier render left in the output folder.
Status clear_folder(const std::filesystem::path& folder) {
  LFD_TRY(const int frames, remove_frames(folder));
  if (frames > 0)
    std::cerr << fmt::format("{}: {} of an earlier render {} removed\n", folder.string(),
                             frames_text(static_cast<std::uint32_t>(frames)), frames == 1 ? "is" : "are");
  return {};
}

Status check_images(const RenderOptions& options, const Cluster& cluster,
                    const std::vector<proto::FrameReport>& frames) {
  std::string missing;
  int count = 0;
  for (const proto::FrameReport& frame : frames) {
    for (const int module : cluster.modules()) {
      for (int buffer = proto::BufferKind_MIN; buffer <= proto::BufferKind_MAX; ++buffer) {
        const bool wanted = buffer == proto::COLOR || (options.buffers >> buffer & 1u) != 0;
        const auto path = image_path(options.cluster.images, frame.frame(), static_cast<std::uint32_t>(module),
                                     static_cast<proto::BufferKind>(buffer));
        if (!wanted || std::filesystem::exists(path)) continue;
        if (count++ == 0) missing = path.string();
      }
    }
    if (frame.stale_module_size() > 0) {
      return Error(fmt::format("frame {}: {} modules are stale", frame.frame(), frame.stale_module_size()));
    }
  }
  if (frames.size() != options.frames)
    return Error(fmt::format("{} of {}", frames.size(), frames_text(options.frames)));
  if (count > 0) return Error(fmt::format("{} images are missing, the first is {}", count, missing));
  return {};
}

Status draw(const RenderOptions& options, Cluster& cluster, StopSignals& signals) {
  LFD_TRY(ControlClient client, ControlClient::connect(cluster.endpoint(), cluster.key_file()));
  LFD_TRY(ControlClient watcher, ControlClient::connect(cluster.endpoint(), cluster.key_file()));
  LFD_TRY_STATUS(await_scene(cluster, watcher, signals));
  LFD_TRY_STATUS(clear_folder(options.cluster.images));  // not before: without a scene nothing comes in its place
  std::vector<proto::FrameReport> frames;
  const auto modules = static_cast<std::uint32_t>(std::max<std::size_t>(1, cluster.modules().size()));
  const std::uint32_t most = std::max<std::uint32_t>(1, kModuleReportsPerRequest / modules);
  while (frames.size() < options.frames) {
    const auto left = options.frames - static_cast<std::uint32_t>(frames.size());
    LFD_TRY(const proto::Reply reply, await_frames(options, std::min(left, most), cluster, client, watcher, signals));
    frames.insert(frames.end(), reply.frame().begin(), reply.frame().end());
    if (reply.frame().empty()) break;
  }
  LFD_TRY(const proto::Status status, ask_status(watcher));
  std::vector<std::string> warnings(status.scene_warning().begin(), status.scene_warning().end());
  std::ranges::copy(warnings_of(frames, cluster.modules().size()), std::back_inserter(warnings));
  if (const std::vector<int> unowned = unowned_modules(cluster.deployment()); !unowned.empty())
    warnings.push_back(
        fmt::format("modules {} stay dark: no node of the deployment draws them", module_ranges(unowned)));
  LFD_TRY_STATUS(write_file(report_path(options.cluster.images),
                            report_json(cluster.deployment(), status.scene(), frames, warnings)));
  LFD_TRY_STATUS(client.quit(kAnswerPatience));
  LFD_TRY_STATUS(cluster.finish(kWriteOut));
  std::cerr << time_table(frames);
  for (const std::string& warning : warnings) std::cerr << "warning: " << warning << "\n";
  return check_images(options, cluster, frames);
}

}  // namespace

Status render(const RenderOptions& options, StopSignals& signals) {
  LFD_TRY_STATUS(make_folder(options.cluster.images));
  LFD_TRY(const FolderLock lock, FolderLock::take(options.cluster.images));
  ClusterOptions cluster_options = options.cluster;
  cluster_options.idle = true;
  LFD_TRY(Cluster cluster, Cluster::start(cluster_options, signals));
  const Status done = draw(options, cluster, signals);
  cluster.stop(kStopPatience);
  return done;
}

void add_render_command(CLI::App& app, int& exit_code) {
  struct Arguments {
    RenderOptions options;
    std::vector<std::string> buffers;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = add_command(app, "render", "Render frames to files and leave", exit_code, [arguments] {
    const auto buffers = parse_buffers(arguments->buffers);
    if (!buffers) return wrong_use(buffers.error());
    arguments->options.buffers = *buffers;
    const RenderOptions& options = arguments->options;
    const int code = do_with_cluster(options.cluster, [&](StopSignals& signals) { return render(options, signals); });
    if (code == kExitDone)
      std::cout << fmt::format("{} in {}\n", frames_text(options.frames), options.cluster.images.string());
    return code;
  });
  RenderOptions& options = arguments->options;
  add_cluster_options(*command, options.cluster);
  command->add_option("--frames", options.frames, "How many frames")
      ->check(whole_number_within(1, 10000))
      ->capture_default_str();
  command->add_option("--out", options.cluster.images, "Folder for images and report.json")->required();
  add_list(*command, "--buffers", arguments->buffers,
           "color,position,normal,ao,depth,bent_normal: what is written (color always is)");
  command->add_flag("--time-modules", options.time_modules, "Report times for each module by itself (slower)");
}

}  // namespace lfd
