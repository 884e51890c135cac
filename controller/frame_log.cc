// The ring of frame reports.
#include "controller/frame_log.h"

#include <algorithm>
#include <utility>

#include "base/check.h"

namespace lfd::controller {

std::vector<double> matrix_rows(const Affine<Physical, World>& physical_from_world) {
  std::vector<double> rows;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) rows.push_back(physical_from_world.linear[column][row]);
    rows.push_back(physical_from_world.offset[row]);
  }
  rows.insert(rows.end(), {0, 0, 0, 1});
  return rows;
}

void FrameLog::begun(std::uint64_t frame, const RegionOfInterest& roi, const std::string& state_hash,
                     Clock::time_point now) {
  LFD_CHECK(entries_.empty() || entries_.back().report.frame() < frame, "frames begin in order");
  proto::FrameReport report;
  report.set_frame(frame);
  for (const double number : matrix_rows(physical_from_world(roi))) report.add_physical_from_world(number);
  const Point3<World> origin = position_origin(roi);
  report.mutable_position_origin()->set_x(origin.x);
  report.mutable_position_origin()->set_y(origin.y);
  report.mutable_position_origin()->set_z(origin.z);
  report.set_roi_diagonal(roi.diagonal_m());
  report.set_state_hash(state_hash);
  entries_.push_back({std::move(report), now});
  forget_oldest();
}

void FrameLog::forget_oldest() {
  while (entries_.size() > remembered_) {
    report_bytes_ -= entries_.front().report_bytes;
    entries_.pop_front();
  }
}

void FrameLog::nobody_wants_them() {
  remembered_ = kUsuallyRemembered;
  forget_oldest();
}

FrameLog::Entry* FrameLog::find(std::uint64_t frame) {
  const auto found =
      std::ranges::lower_bound(entries_, frame, {}, [](const Entry& entry) { return entry.report.frame(); });
  return found != entries_.end() && found->report.frame() == frame ? &*found : nullptr;
}

const std::string* FrameLog::state_hash(std::uint64_t frame) {
  const Entry* entry = find(frame);
  return entry == nullptr ? nullptr : &entry->report.state_hash();
}

bool FrameLog::reported(std::uint64_t frame, const std::string& node, const proto::NodeReport& report) {
  Entry* entry = find(frame);
  if (entry == nullptr) return true;
  const auto& known = entry->report.node();
  if (std::ranges::any_of(known, [&](const proto::NodeReport& one) { return one.node() == node; })) return false;
  proto::NodeReport& added = *entry->report.add_node() = report;
  added.set_node(node);
  const std::size_t bytes = added.ByteSizeLong();
  entry->report_bytes += bytes;
  report_bytes_ += bytes;
  for (Entry& oldest : entries_) {
    if (report_bytes_ <= kMostReport_bytes) break;
    report_bytes_ -= std::exchange(oldest.report_bytes, 0);
    oldest.report.clear_node();
  }
  return true;
}

void FrameLog::swapped(const FrameBarrier::Swap& swap, const std::vector<std::uint32_t>& stale_modules,
                       Clock::time_point now) {
  last_swapped_ = swap.frame;
  stale_modules_ = stale_modules;
  if (swap.late) ++late_frames_;
  swaps_.happened(now);
  Entry* entry = find(swap.frame);
  if (entry == nullptr) return;
  entry->report.set_begin_to_swap_ms(milliseconds(now - entry->begun));
  for (const std::uint32_t module : stale_modules) entry->report.add_stale_module(module);
}

bool FrameLog::shown(std::uint64_t frame, Clock::time_point now) {
  Entry* entry = find(frame);
  if (entry == nullptr) return true;
  if (entry->shown) return false;
  entry->shown = true;
  entry->report.set_begin_to_shown_ms(milliseconds(now - entry->begun));
  return true;
}

bool FrameLog::all_shown(std::uint64_t first, std::uint64_t count) const {
  const auto shown = std::ranges::count_if(entries_, [&](const Entry& entry) {
    return entry.shown && entry.report.frame() >= first && entry.report.frame() - first < count;
  });
  return static_cast<std::uint64_t>(shown) == count;
}

std::vector<proto::FrameReport> FrameLog::reports(std::uint64_t first, std::uint64_t count) const {
  std::vector<proto::FrameReport> reports;
  for (const Entry& entry : entries_) {
    const std::uint64_t frame = entry.report.frame();
    if (frame >= first && frame - first < count) reports.push_back(entry.report);
  }
  return reports;
}

}  // namespace lfd::controller
