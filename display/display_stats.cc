// Names and values of the display's metrics.
#include "display/display_stats.h"

#include "base/version.h"

namespace lfd::display {

void DisplayStats::joined(std::size_t modules) {
  ++joins_;
  modules_ = modules;
  last_shown_.reset();
}

void DisplayStats::image_came(std::size_t bytes) {
  ++images_;
  image_bytes_ += bytes;
}

void DisplayStats::shown(int fresh_modules, Clock::time_point now) {
  ++frames_;
  fresh_modules_ = fresh_modules;
  if (last_shown_) intervals_.observe_ms(milliseconds(now - *last_shown_));
  last_shown_ = now;
}

MetricPage DisplayStats::page(const std::string& display, const Now& now) const {
  const auto number = [](auto value) { return static_cast<double>(value); };
  MetricPage page({{"display", display}});
  page.gauge("lfd_display_build_info", "1, with the version.", 1, {{"version", kVersion}});
  page.gauge("lfd_display_joined", "1: the controller has taken it in.", now.is_member ? 1 : 0);
  page.counter("lfd_display_joins_total", "How often it was taken in.", number(joins_));
  page.gauge("lfd_display_modules", "Modules of the display.", number(modules_));
  page.gauge("lfd_display_fresh_modules", "Modules with a new picture in the last frame shown.", fresh_modules_);
  page.gauge("lfd_display_nodes", "Nodes that send images.", number(now.nodes));
  page.counter("lfd_display_shown_frames_total", "Frames shown.", number(frames_));
  page.counter("lfd_display_dropped_frames_total", "Frames that were never shown.", number(now.dropped_frames));
  page.histogram("lfd_display_shown_interval_seconds", "Between one frame shown and the next.", intervals_);
  page.counter("lfd_display_images_total", "Images that came.", number(images_));
  page.counter("lfd_display_image_bytes_total", "Of those images.", number(image_bytes_));
  page.counter("lfd_display_refused_images_total", "Images that were not taken.", number(now.refused_images));
  page.counter("lfd_display_failed_pictures_total", "Pictures that could not be written.", number(now.failed_pictures));
  return page;
}

}  // namespace lfd::display
