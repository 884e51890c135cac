// A cluster of daemons that are started one by one, so that a test can take them away: a controller at fixed addresses,
// nodes "left" and "right" (and a spare, where it is asked for), and a display that writes every frame.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "bench/common/daemons.h"
#include "tests/system/running_cluster.h"

namespace lfd::harness {

class FaultStage {
 public:
  using Environment = std::map<std::string, std::string>;

  // `more`: of the deployment, beside addresses, sink and pacing (20 frames a second, heartbeats of 100 ms: a node that
  // is silent for 0.6 s is out).
  // `host`: where the controller and the display are reached.
  explicit FaultStage(const std::string& more, std::string pacing = kPacing, const std::string& host = "127.0.0.1");
  // Where the test has failed: prints the last words of every daemon.
  ~FaultStage();

  static constexpr const char* kPacing = "pacing { frames_per_second: 20 heartbeat_ms: 100 deadline_ms: 250 }";

  // Starts a daemon: "controller", "display", or a node by its name. One that runs under the name is killed.
  Process& start_as(const std::string& name, bench::Daemons::Start how);
  Process& start(const std::string& name, std::map<std::string, std::string> environment = {}) {
    return start_as(name, {.environment = std::move(environment)});
  }
  Process& operator[](const std::string& name) { return daemons_->at(name); }
  // SIGKILL, and waits for the end.
  void kill(const std::string& name);

  // Whether the controller that runs swapped frame after frame, from its first on: never longer apart than an interval
  // and a deadline of kPacing, and one more deadline for a busy machine, which is less than the six heartbeats that it
  // would take to wait for a silent peer.
  testing::AssertionResult frames_went_on();

  const std::string& endpoint() const { return endpoint_; }
  const std::filesystem::path& deployment() const { return deployment_; }
  std::filesystem::path shown() const { return bench_.folder() / "shown"; }

  std::uint64_t last_frame() const;

  // Waits until all nodes draw the controller's state, and three more frames are shown.
  testing::AssertionResult is_whole() const;
  // Waits until right is out and a spare named "reserve" draws: nothing is stale.
  testing::AssertionResult is_whole_by_spare() const;

  // What the controller says of right; also in its last frames before it is out.
  static constexpr const char* kLate = "\"right\" is late";

  // The colour pictures (bytes of the PNGs) of the first frame from `frame` on that has those of all four modules and
  // has a successor: it is written whole.
  std::map<int, std::string> pictures_from(std::uint64_t frame) const;

  // Of this frame alone, as far as they are there.
  std::map<int, std::string> pictures_of(std::uint64_t frame) const;

  // The last frame of which the display has written anything.
  std::optional<std::uint64_t> last_shown_frame() const;
  // Waits until the display has written a frame later than this one.
  testing::AssertionResult shows_frames_after(std::uint64_t frame) const;

 private:
  Workbench bench_{ImageSize{64, 48}};
  std::set<std::string> started_;
  std::string endpoint_;
  std::filesystem::path deployment_;
  std::optional<bench::Daemons> daemons_;
};

}  // namespace lfd::harness
