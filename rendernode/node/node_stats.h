// What a render node tells Prometheus: its frames, the time of its stages, what it sent. Told events and the time.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>

#include "base/clock.h"
#include "base/metric_page.h"
#include "proto/wire.pb.h"

namespace lfd::node {

class NodeStats {
 public:
  // The controller has taken the node in, with so many modules.
  void joined(std::size_t modules);

  // The life of frames. begun: the announcement has come.
  void begun(std::uint64_t frame, Clock::time_point now);
  void drawn(std::uint64_t frame, Clock::time_point now);
  void ready(std::uint64_t frame, const proto::NodeReport& report, Clock::time_point now);

  void sent_image(std::size_t bytes);

  // docs/metrics.md says what each of them is. The numbers that the daemon has itself are told here.
  struct Now {
    bool is_member = false;
    std::uint64_t sequence = 0;        // of the state it holds
    std::uint64_t dropped_frames = 0;  // whose images a slow sink did not take
  };
  MetricPage page(const std::string& node, const Now& now) const;

 private:
  struct Begun {
    std::uint64_t frame;
    Clock::time_point at;
  };
  void observe(DurationHistogram& histogram, std::uint64_t frame, Clock::time_point now) const;

  std::deque<Begun> begun_;  // the last ones
  std::size_t modules_ = 0;
  std::uint64_t joins_ = 0, frames_ = 0, failed_frames_ = 0, images_ = 0, image_bytes_ = 0;
  DurationHistogram begin_to_drawn_, begin_to_ready_;
  std::map<std::string, DurationHistogram> stages_;  // by pass
};

}  // namespace lfd::node
