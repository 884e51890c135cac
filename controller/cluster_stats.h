// What people ask of a cluster that runs: how fast, how late, since when, and what went wrong last. Told events and the
// time.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/clock.h"
#include "base/metric_page.h"
#include "controller/frame_barrier.h"
#include "controller/rate_window.h"
#include "proto/wire.pb.h"

namespace lfd::controller {

class ClusterStats {
 public:
  explicit ClusterStats(Clock::time_point now) : started_(now) {}

  // The life of frames.
  void begun(std::uint64_t frame, Clock::time_point now);
  void ready(const std::string& node, const proto::Ready& ready, Clock::time_point now);
  void swapped(const FrameBarrier::Swap& swap, Clock::time_point now);
  // `display`: empty where the frame needs none.
  void shown(const std::string& display, std::uint64_t frame, Clock::time_point now);

  // What went over the wire.
  void published(std::size_t bytes) { published_bytes_ += bytes; }
  void refused() { ++refused_messages_; }
  void join_refused(const std::string& name, const std::string& why);

  // This process belongs to the cluster. What is told of one that was never told to belong concerns only the whole.
  void joined(const std::string& peer) { peers_[peer]; }
  // The others are forgotten: names of displays come and go.
  void keep_only(const std::set<std::string>& peers);
  // What was warned of. `peer`: whose fault; empty: of no single one.
  void fault(const std::string& peer, const std::string& what);

  // Fills in what it knows. Peers with their modules are there already, and the refused messages that sockets counted.
  void fill(proto::Status& status, const std::vector<std::uint32_t>& stale_modules, Clock::time_point now) const;

  std::uint64_t swapped_frames() const { return swapped_frames_; }
  std::uint64_t faults(const std::string& peer) const;  // of one; of the whole: of all, with ""
  const DurationHistogram& begin_to_swap() const { return begin_to_swap_; }
  const DurationHistogram& begin_to_shown() const { return begin_to_shown_; }

 private:
  struct PeerEntry {
    RateWindow frames;
    double begin_to_ready_ms = 0;
    google::protobuf::RepeatedPtrField<proto::PassTime> passes;  // of the last frame
    std::string occlusion_choice;
    std::uint64_t image_bytes = 0;
    std::string last_fault;
    std::uint64_t faults = 0;
  };
  struct Begun {
    std::uint64_t frame;
    Clock::time_point at;
  };
  // Since the frame began; absent where that is forgotten.
  std::optional<double> milliseconds_since_begin(std::uint64_t frame, Clock::time_point now) const;

  Clock::time_point started_;
  std::deque<Begun> begun_;  // the last ones, in order
  std::map<std::string, PeerEntry> peers_;
  double begin_to_swap_ms_ = 0, begin_to_shown_ms_ = 0;  // of the last ones
  DurationHistogram begin_to_swap_, begin_to_shown_;
  std::uint64_t swapped_frames_ = 0, shown_frames_ = 0, published_bytes_ = 0, refused_messages_ = 0, faults_ = 0;
  std::string last_fault_;
};

}  // namespace lfd::controller
