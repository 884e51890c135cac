// What is remembered of the last frames: their geometry, what each node reported, when they were swapped and shown.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "base/clock.h"
#include "calibration/spaces/roi.h"
#include "controller/frame_barrier.h"
#include "controller/rate_window.h"
#include "proto/wire.pb.h"

namespace lfd::controller {

class FrameLog {
 public:
  // The frame begins with this region of interest and state.
  void begun(std::uint64_t frame, const RegionOfInterest& roi, const std::string& state_hash, Clock::time_point now);

  // Of the state that the frame shows; null where the frame is forgotten.
  const std::string* state_hash(std::uint64_t frame);

  // A node's report of a frame; its first one counts, of others the answer is false. Reports of frames that are
  // forgotten have no effect, and the oldest are forgotten where all of them together are larger than
  // kMostReport_bytes.
  bool reported(std::uint64_t frame, const std::string& node, const proto::NodeReport& report);

  void swapped(const FrameBarrier::Swap& swap, const std::vector<std::uint32_t>& stale_modules, Clock::time_point now);

  // The display or output has the complete frame. False where that was known.
  bool shown(std::uint64_t frame, Clock::time_point now);

  std::optional<std::uint64_t> last_swapped() const { return last_swapped_; }
  // Whether each of the frames first .. first + count - 1 has been shown.
  bool all_shown(std::uint64_t first, std::uint64_t count) const;
  std::uint64_t late_frames() const { return late_frames_; }
  const std::vector<std::uint32_t>& stale_modules() const { return stale_modules_; }

  // Of the frames swapped in the last seconds; 0 where nothing is.
  double frames_per_second(Clock::time_point now) const { return swaps_.per_second(now); }

  // Reports of frames first .. first + count - 1, as far as they are remembered.
  std::vector<proto::FrameReport> reports(std::uint64_t first, std::uint64_t count) const;

  static constexpr std::size_t kRemembered = 10000;
  // Of a show that nobody asks to be told of: enough for what is under way and late.
  static constexpr std::size_t kUsuallyRemembered = 64;

  // So many frames are wanted, which begin from now on: they are remembered until nobody_wants_them().
  void remember(std::size_t frames) { remembered_ = std::min(kRemembered, frames + kUsuallyRemembered); }
  void nobody_wants_them();
  static constexpr std::size_t kMostReport_bytes = std::size_t{256} << 20;

 private:
  struct Entry {
    proto::FrameReport report;
    Clock::time_point begun;
    bool shown = false;
    std::size_t report_bytes = 0;  // of the nodes
  };
  Entry* find(std::uint64_t frame);

  void forget_oldest();

  std::size_t remembered_ = kUsuallyRemembered;
  std::deque<Entry> entries_;  // by frame number
  RateWindow swaps_;
  std::size_t report_bytes_ = 0;
  std::vector<std::uint32_t> stale_modules_;
  std::optional<std::uint64_t> last_swapped_;
  std::uint64_t late_frames_ = 0;
};

// The 16 numbers of the 4x4 matrix of physical_from_world, row-major.
std::vector<double> matrix_rows(const Affine<Physical, World>& physical_from_world);

}  // namespace lfd::controller
