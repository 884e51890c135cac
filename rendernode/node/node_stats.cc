// Names and values of the node's metrics.
#include "rendernode/node/node_stats.h"

#include <algorithm>

#include "base/version.h"

namespace lfd::node {
namespace {

constexpr std::size_t kRemembered = 64;  // frames

}  // namespace

void NodeStats::joined(std::size_t modules) {
  ++joins_;
  modules_ = modules;
  begun_.clear();
}

void NodeStats::begun(std::uint64_t frame, Clock::time_point now) {
  begun_.push_back({frame, now});
  if (begun_.size() > kRemembered) begun_.pop_front();
}

void NodeStats::observe(DurationHistogram& histogram, std::uint64_t frame, Clock::time_point now) const {
  const auto found = std::ranges::find(begun_, frame, &Begun::frame);
  if (found != begun_.end()) histogram.observe_ms(milliseconds(now - found->at));
}

void NodeStats::drawn(std::uint64_t frame, Clock::time_point now) { observe(begin_to_drawn_, frame, now); }

void NodeStats::ready(std::uint64_t frame, const proto::NodeReport& report, Clock::time_point now) {
  if (!report.error().empty()) {
    ++failed_frames_;
    return;
  }
  ++frames_;
  observe(begin_to_ready_, frame, now);
  std::map<std::string, double> ms;  // a pass may be several entries: one for each module
  for (const proto::PassTime& pass : report.pass())
    ms[pass.pass()] += pass.gpu_ms() > 0 ? pass.gpu_ms() : pass.cpu_ms();
  for (const auto& [pass, sum] : ms) stages_[pass].observe_ms(sum);
}

void NodeStats::sent_image(std::size_t bytes) {
  ++images_;
  image_bytes_ += bytes;
}

MetricPage NodeStats::page(const std::string& node, const Now& now) const {
  const auto number = [](auto value) { return static_cast<double>(value); };
  MetricPage page({{"node", node}});
  page.gauge("lfd_node_build_info", "1, with the version.", 1, {{"version", kVersion}});
  page.gauge("lfd_node_joined", "1: the controller has taken it in.", now.is_member ? 1 : 0);
  page.counter("lfd_node_joins_total", "How often it was taken in.", number(joins_));
  page.gauge("lfd_node_modules", "Modules it draws.", number(modules_));
  page.gauge("lfd_node_state_sequence", "Number of the last update whose state it holds.", number(now.sequence));
  page.counter("lfd_node_frames_total", "Frames that were ready.", number(frames_));
  page.counter("lfd_node_failed_frames_total", "Frames that could not be drawn.", number(failed_frames_));
  page.counter("lfd_node_dropped_frames_total", "Frames whose images a slow sink did not take.",
               number(now.dropped_frames));
  page.histogram("lfd_node_begin_to_drawn_seconds", "From the begin of a frame until the GPU is done.",
                 begin_to_drawn_);
  page.histogram("lfd_node_begin_to_ready_seconds", "From the begin of a frame until its images are in hand.",
                 begin_to_ready_);
  for (const auto& [pass, times] : stages_)
    page.histogram("lfd_node_stage_seconds", "Of each pass: on the GPU, or on the CPU where it is the CPU's work.",
                   times, {{"pass", pass}});
  page.counter("lfd_node_images_total", "Images sent to the display.", number(images_));
  page.counter("lfd_node_image_bytes_total", "Of those images.", number(image_bytes_));
  return page;
}

}  // namespace lfd::node
