// Decides what of a show is recorded: told what is published and which assets came, it gives out events and assets to
// write, and says what to ask for. No sockets, no clock, no file.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/clock.h"
#include "proto/asset_gatherer.h"
#include "proto/recording.pb.h"
#include "proto/state_follower.h"

namespace lfd {

class ShowRecorder {
 public:
  // What waits for a snapshot; beyond it the oldest is forgotten, and another snapshot asked for.
  static constexpr std::size_t kMostWaiting = 4096;
  static constexpr std::size_t kMostWaiting_bytes = std::size_t{256} << 20;

  // `most_frames`: with the swap of so many frames the show is over; absent: never.
  explicit ShowRecorder(std::uint32_t piece_bytes, std::optional<std::uint64_t> most_frames = {})
      : gatherer_(piece_bytes), most_frames_(most_frames) {}

  // What came on the state channel, in its order.
  void heard(const proto::Envelope& message, Clock::time_point now);
  // A snapshot that was asked for after wants_snapshot() had become true.
  void snapshot_came(const proto::State& state, Clock::time_point now);
  // Pieces of assets come and are asked for here.
  AssetGatherer& gatherer() { return gatherer_; }

  // The subscription is known to have arrived, and there is no state that updates can be applied to.
  bool wants_snapshot() const { return hears_ && waits_; }

  // To be written, in this order; each is given out once.
  std::vector<proto::RecordingEvent> take_events();
  struct Asset {
    std::string hash;
    std::shared_ptr<const std::string> content;
  };
  std::vector<Asset> take_assets();

  // As many frames as it was to hear: what is said from now on has no effect, assets are still taken.
  bool has_enough() const { return most_frames_ && swapped_ >= *most_frames_; }
  bool has_begun() const { return started_.has_value(); }  // the first state is there
  std::uint64_t begun_frames() const { return begun_; }
  std::uint64_t swapped_frames() const { return swapped_; }  // of those
  std::uint64_t left_out_frames() const { return left_out_; }
  std::uint64_t snapshots() const { return snapshots_; }
  std::size_t assets() const { return written_.size(); }
  std::size_t missing_assets() const { return named_.size() - written_.size(); }  // of all scenes so far

  // Why nothing more can come of this show.
  struct End {
    std::string reason;
    bool is_fault = false;  // the controller was lost, not ended
  };
  const std::optional<End>& end() const { return end_; }

 private:
  struct Heard {
    proto::Envelope message;
    Clock::time_point at;
    std::size_t bytes = 0;
  };
  void want_assets();
  void take(const proto::Envelope& message, Clock::time_point at);
  void take_update(const proto::Update& update, Clock::time_point at);
  void take_begin(const proto::BeginFrame& begin, Clock::time_point at);
  void wait_with(const proto::Envelope& message, Clock::time_point at);
  void record(proto::RecordingEvent event, Clock::time_point at);
  bool is_of_another_life(const proto::Envelope& message);

  StateFollower follower_;
  AssetGatherer gatherer_;
  std::optional<std::uint64_t> most_frames_;
  bool hears_ = false, waits_ = true;
  std::deque<Heard> waiting_;
  std::size_t waiting_bytes_ = 0;
  std::uint64_t session_ = 0, heard_sequence_ = 0;
  std::optional<std::uint64_t> heard_frame_;
  std::set<std::uint64_t> open_;  // frames that were recorded as begun and have not swapped
  std::vector<proto::RecordingEvent> events_;
  std::set<std::string> named_, written_;  // assets
  std::optional<Clock::time_point> started_;
  std::uint64_t last_nanoseconds_ = 0;
  std::uint64_t begun_ = 0, swapped_ = 0, left_out_ = 0, snapshots_ = 0;
  std::optional<End> end_;
};

}  // namespace lfd
