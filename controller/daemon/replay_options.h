// What a command line says of a replay.
#pragma once

#include <filesystem>
#include <string>

#include "base/command_line.h"
#include "controller/replay/replay.h"

namespace lfd::controller {

struct ReplayArguments {
  std::filesystem::path file;  // empty: no replay
  Replay::Options options;
};

// --replay, --replay-speed, --replay-frames, --replay-any-display; not together with options that change the show.
inline void add_replay_options(CLI::App& app, ReplayArguments& a) {
  CLI::Option* file = app.add_option("--replay", a.file, "Show what `lfd record` recorded instead of a scene, then end")
                          ->excludes("--scene", "--roi", "--plan", "--no-ao", "--idle");
  app.add_option("--replay-speed", a.options.speed,
                 "Times the recorded pace (0: as fast as the nodes draw, and every frame whole)")
      ->check(number_within(0, 1000))
      ->capture_default_str()
      ->needs(file);
  const auto take_frames = [&a](const std::string& text) {
    const auto frames = parse_frame_range(text);
    if (!frames) throw CLI::ValidationError("--replay-frames", frames.error().message());
    a.options.frames = *frames;
  };
  app.add_option_function<std::string>("--replay-frames", take_frames, "Of these frames alone (default: all)")
      ->type_name("A-B")
      ->needs(file);
  app.add_flag("--replay-any-display", a.options.any_display, "Even where it was recorded on another display")
      ->needs(file);
}

inline Result<Replay> open_replay(const ReplayArguments& a, const DisplayCalibration& display) {
  return Replay::open(a.file, display, a.options);
}

}  // namespace lfd::controller
