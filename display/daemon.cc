// Opening the display's sockets.
#include "display/daemon.h"

#include <algorithm>

#include "base/signals.h"
#include "display/display_loop.h"

namespace lfd::display {
namespace {

constexpr std::int64_t kMostQueued_bytes = std::int64_t{256} << 20;  // of one connection, not looked at yet

}  // namespace

wire::Limits image_limits(const std::optional<ImageSize>& image) {
  wire::Limits limits = wire::kImages;
  if (!image) return limits;
  const std::int64_t largest = std::int64_t{16} * image->width * image->height;  // packed, one may grow a little
  limits.max_part_bytes = std::min(limits.max_part_bytes, largest + largest / 64 + wire::kShort_bytes);
  limits.queued_to_send = limits.queued_messages;
  const std::int64_t fit = kMostQueued_bytes / limits.max_part_bytes;
  limits.queued_messages =
      static_cast<int>(std::clamp<std::int64_t>(fit, std::int64_t{2} * kImagesPerPass, limits.queued_messages));
  return limits;
}

Status run_daemon(const DaemonOptions& options) {
  StopSignals signals;
  LFD_TRY(const auto metrics, open_metrics("lfd-display", options.metrics));
  LFD_TRY(const auto context, wire::open_context(options.key_file));
  LFD_TRY(wire::Socket images,
          wire::bind_router(*context, options.images, image_limits(options.image), wire::Listener::kDisplay));
  LFD_TRY(wire::Socket control, wire::connect_dealer(*context, options.controller));
  DisplayLoop loop(options, *context, std::move(images), std::move(control), metrics.get());
  return loop.run(signals);
}

}  // namespace lfd::display
