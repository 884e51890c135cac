// Decides what a replay of a recorded show draws next and when it is due: each frame with what changes before it. Reads
// the recording; no sockets, no clock.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "base/clock.h"
#include "base/result.h"
#include "calibration/display.h"
#include "proto/recording_reader.h"
#include "proto/scene_data.h"
#include "proto/state_hasher.h"
#include "proto/wire.pb.h"

namespace lfd::controller {

class Replay {
 public:
  struct Options {
    double speed = 1;  // times the recorded pace; 0: as fast as the nodes draw, and each frame whole
    std::optional<FrameRange> frames = {};  // absent: all
    bool any_display = false;               // a recording of another display than `display` is replayed too
  };

  // Errors: a file that is none, is damaged or has no such frames; another display's, which is named.
  static Result<Replay> open(const std::filesystem::path& file, const DisplayCalibration& display,
                             const Options& options);
  static Result<Replay> of(Recording recording, const DisplayCalibration& display, const Options& options);

  // How the state of one frame becomes that of the next.
  struct Change {
    proto::Update update;          // without a number
    std::optional<Assets> assets;  // of the scene, where the update has one
  };
  struct Cue {
    std::uint64_t frame = 0;  // as it was recorded
    std::chrono::nanoseconds at{0};
    std::string state_hash;
    std::optional<Change> change;  // absent where nothing changes
    std::uint64_t offset = 0;      // in the file
  };
  // The next frame; null after the last one.
  const Cue* next() const { return next_ ? &*next_ : nullptr; }
  // Its change, which is to be made before it begins, or as early as at the start; absent once it was taken.
  std::optional<Change> take_change();
  // When it is due; absent where there is none, or no pace.
  std::optional<Clock::time_point> due_at() const;
  bool due(Clock::time_point now) const;
  // The next frame begins: on to the one after it. Error: the recording is damaged there; next() is null then.
  Status begun(Clock::time_point now);

  // A node has drawn a frame from the state of this hash. Error: it is not the recorded one.
  Status drawn(std::uint64_t frame, const std::string& node, const std::string& state_hash);

  bool waits_for_every_node() const { return options_.speed == 0; }
  bool has_begun() const { return last_frame_.has_value(); }
  std::optional<std::uint64_t> last_frame() const { return last_frame_; }  // that has begun
  const Recording& recording() const { return recording_; }

  // For people: what will be replayed, and what was.
  std::string title() const;
  std::string summary() const;

 private:
  Replay(Recording recording, const Options& options) : recording_(std::move(recording)), options_(options) {}
  Status read_on();
  // What an event changes of state_. Its errors do not name the place.
  Status take(const proto::RecordingEvent& event);
  Status take_assets();
  Result<Cue> cue_of(const proto::RecordingEvent& event, std::uint64_t offset);
  // What has moved since the last frame that was replayed.
  void add_moved(proto::Update& update) const;

  Recording recording_;
  Options options_;
  proto::State state_;          // with the recorded numbers
  StateHasher hasher_{state_};  // of state_
  Assets assets_;               // of its scene
  bool lacks_assets_ = false;
  // What has changed since the last frame that was replayed.
  bool scene_changed_ = false, roi_changed_ = false, render_changed_ = false, buffers_changed_ = false;
  std::set<std::uint32_t> moved_instances_, moved_lights_;
  std::optional<Cue> next_;
  std::chrono::nanoseconds first_at_{0};  // of the first frame replayed
  std::optional<Clock::time_point> started_;
  std::optional<std::uint64_t> last_frame_;
  std::map<std::uint64_t, std::string> hashes_;  // of the last frames that began
  std::uint64_t replayed_ = 0, left_out_ = 0, drawn_ = 0, differing_ = 0;
};

}  // namespace lfd::controller
