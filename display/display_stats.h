// What a display tells Prometheus: the frames it showed, the images it took. Told events and the time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/clock.h"
#include "base/metric_page.h"

namespace lfd::display {

class DisplayStats {
 public:
  // The controller has taken it in, with so many modules.
  void joined(std::size_t modules);
  void image_came(std::size_t bytes);
  void shown(int fresh_modules, Clock::time_point now);

  // docs/metrics.md says what each of them is. The numbers that others count are told here.
  struct Now {
    bool is_member = false;
    std::size_t nodes = 0;  // that send images
    std::uint64_t dropped_frames = 0, refused_images = 0, failed_pictures = 0;
  };
  MetricPage page(const std::string& display, const Now& now) const;

 private:
  std::size_t modules_ = 0;
  int fresh_modules_ = 0;  // of the last frame
  std::uint64_t joins_ = 0, frames_ = 0, images_ = 0, image_bytes_ = 0;
  std::optional<Clock::time_point> last_shown_;
  DurationHistogram intervals_;
};

}  // namespace lfd::display
