// lfd view: what a viewer in front of the display sees.
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "base/file.h"
#include "base/log.h"
#include "base/temporary_folder.h"
#include "calibration/check/derivatives.h"
#include "cli/lfd_commands.h"
#include "proto/frame_files.h"

namespace lfd {
namespace fs = std::filesystem;
namespace {

constexpr auto kViewPatience = std::chrono::minutes(10);

struct Arguments {
  ClusterOptions cluster;
  std::vector<double> eye;      // X,Y,Z; empty: `place` says it
  std::optional<double> place;  // on the observers' line or arc, in widths of the screen from its middle
  std::string out;
  std::string frames;  // folder of lfd render; empty: one frame is rendered
};

// Before the point of the screen that is so far from its middle.
std::vector<double> eye_on_observer_line(const DisplayCalibration& display, double place) {
  const Optics& optics = display.optics;
  const ScreenPoint before{place * display.screen.width_m, optics.observer_height_m};
  const Point3<Physical> eye = optics.observer_arc ? point_before_screen(optics, before, optics.observer_distance_m)
                                                   : Point3<Physical>{before.x, before.y, optics.observer_distance_m};
  return {eye.x, eye.y, eye.z};
}

// Lets lfd-display make the picture from a frame's folder.
Status look(const Arguments& arguments, const fs::path& frame, StopSignals& signals) {
  LFD_TRY(const Deployment deployment, load_deployment(arguments.cluster));
  const std::vector<double> eye =
      arguments.place ? eye_on_observer_line(deployment.display, *arguments.place) : arguments.eye;
  Process::Options options{
      .name = "view",
      .command = {own_folder() / "lfd-display", "view", "--frames-dir", frame, "--display", deployment.display_file,
                  fmt::format("--eye={}", fmt::join(eye, ",")), "--out", arguments.out},
      .on_line =
          [](std::string_view line) {
            if (!line.starts_with(kErrorMark)) std::cerr << line << std::endl;
          },
      .environment = {}};
  LFD_TRY(const auto process, Process::start(std::move(options)));
  const auto deadline = Clock::now() + kViewPatience;
  while (Clock::now() < deadline) {
    if (const auto exit = process->wait(std::chrono::milliseconds(50))) {
      return exit->succeeded() ? Status() : Status(Error("lfd-display view: " + last_words(*process)));
    }
    if (const auto signal = signals.take()) return Error(fmt::format("ended by signal {}", *signal));
  }
  return Error("lfd-display view: does not end");
}

Status view(const Arguments& arguments, StopSignals& signals) {
  if (!arguments.frames.empty()) {
    const fs::path first = frame_path(arguments.frames, 0);
    return look(arguments, fs::is_directory(first) ? first : fs::path(arguments.frames), signals);
  }
  LFD_TRY(const TemporaryFolder folder, TemporaryFolder::make("lfd-view"));
  RenderOptions render_options;
  render_options.cluster = arguments.cluster;
  render_options.cluster.images = folder.path();
  LFD_TRY_STATUS(render(render_options, signals));
  return look(arguments, frame_path(folder.path(), 0), signals);
}

}  // namespace

void add_view_command(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = add_command(app, "view", "Write what a viewer at a place sees", exit_code, [arguments] {
    if (arguments->eye.empty() && !arguments->place) return wrong_use(Error("--eye or --place is needed"));
    if (!arguments->place && !(arguments->eye[2] > 0))
      return wrong_use(Error("--eye: z must be > 0: a viewer stands in front of the screen"));
    const ClusterOptions& cluster = arguments->cluster;
    const bool is_rendering_told = !cluster.scene.empty() || !cluster.roi.empty() || !cluster.modules.empty() ||
                                   !cluster.plan.empty() || cluster.no_ao;
    if (!arguments->frames.empty() && is_rendering_told)
      return wrong_use(
          Error("--frames-dir: nothing is rendered: --scene, --roi, --module, --plan and --no-ao have no say"));
    if (const Status writable = check_writable(arguments->out); !writable) return fail(writable.error());
    return do_with_cluster(arguments->cluster, [&](StopSignals& signals) { return view(*arguments, signals); });
  });
  add_cluster_options(*command, arguments->cluster);
  CLI::Option* eye = add_numbers(*command, "--eye", arguments->eye, "X,Y,Z",
                                 "Of the eye in physical metres (z: distance from the screen)");
  command
      ->add_option(
          "--place", arguments->place,
          "In its place: before the screen's middle (0), on the observers' line, so many widths of the screen aside")
      ->check(number_within(-1, 1))
      ->excludes(eye);
  command->add_option("--out", arguments->out, "PNG file to write")->required()->check(file_ending(".png"));
  command->add_option("--frames-dir", arguments->frames,
                      "Use images that `lfd render` wrote: the folder of a frame, or its parent (then frame 0)");
}

}  // namespace lfd
