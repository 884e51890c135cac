// The cluster of a soak: its processes, its controller's answers, what it shows; kept going by look().
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "base/clock.h"
#include "base/signals.h"
#include "base/temporary_folder.h"
#include "bench/common/daemons.h"
#include "bench/soak/frame_checker.h"
#include "bench/soak/listener.h"
#include "bench/soak/pause_watch.h"
#include "bench/soak/soak_table.h"
#include "cli/control_client.h"

namespace lfd::bench {

// Nodes "left" and "right" draw eight modules, "reserve" is a spare.
class SoakCluster {
 public:
  static Result<std::unique_ptr<SoakCluster>> start(StopSignals& signals);

  Daemons& daemons() { return *daemons_; }
  // Kills it first, where it runs. "left" will lose its GL context every 300 frames (15 s), for some hours.
  Status start_daemon(const std::string& name);

  // Waits; meanwhile the state changes several times a second, and what is shown is looked at. An error: a signal came.
  Status look_for(Clock::duration time);
  // Until `done`; whether it was in time.
  Result<bool> look_until(const std::function<bool()>& done, Clock::duration at_most);

  // Asks for the other one of two scenes.
  Status change_scene();
  bool shows_other_scene() const { return other_scene_; }

  // All draw the controller's state and frames are shown.
  bool is_whole();
  // The spare stands in for a node.
  bool spare_draws();
  std::optional<proto::Status> status();
  std::uint64_t last_frame() const { return checker_.last_swapped().value_or(0); }

  // Between two swaps, since forget_pauses; one that goes on counts so far.
  Clock::duration longest_pause();
  void forget_pauses();

  // Of the processes that nobody took away, those that have ended, and by what.
  std::vector<std::string> dead() const;

  // Counts so far.
  SoakTable counts;

 private:
  SoakCluster(StopSignals& signals, TemporaryFolder folder) : signals_(signals), folder_(std::move(folder)) {}
  Status write_files();
  void hear();
  void change_state();
  void look_at_frames();
  void look_at_frame(std::uint64_t frame);
  bool is_of_this_life(const std::filesystem::path& picture, std::uint64_t frame) const;

  StopSignals& signals_;
  TemporaryFolder folder_;
  std::string control_, state_;
  std::unique_ptr<Daemons> daemons_;
  std::unique_ptr<ControlClient> client_;
  std::unique_ptr<Listener> listener_;
  FrameChecker checker_;
  // When each frame of this life of the controller began: another life may have had one of the same number.
  std::map<std::uint64_t, std::filesystem::file_time_type> begun_at_;
  bool other_scene_ = false;
  std::uint64_t changes_ = 0, painted_ = 0, late_before_ = 0, late_now_ = 0;
  PauseWatch pauses_;
  proto::Scene first_scene_;
  Clock::time_point next_change_{}, next_look_{};
};

}  // namespace lfd::bench
