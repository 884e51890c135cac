// Opening the display's sockets.
#include "display/daemon.h"

#include <algorithm>

#include "base/signals.h"
#include "display/display_loop.h"

namespace lfd::display {
namespace {

// What is larger than any image of the display is not even taken in; packed, one may grow a little.
wire::Limits limits_for(const DaemonOptions& options) {
  wire::Limits limits = wire::kImages;
  if (!options.image) return limits;
  const std::int64_t largest = std::int64_t{16} * options.image->width * options.image->height;
  limits.max_part_bytes = std::min(limits.max_part_bytes, largest + largest / 64 + wire::kShort_bytes);
  return limits;
}

}  // namespace

Status run_daemon(const DaemonOptions& options) {
  StopSignals signals;
  LFD_TRY(const auto metrics, open_metrics("lfd-display", options.metrics));
  LFD_TRY(const auto context, wire::open_context(options.key_file));
  LFD_TRY(wire::Socket images,
          wire::bind_router(*context, options.images, limits_for(options), wire::Listener::kDisplay));
  LFD_TRY(wire::Socket control, wire::connect_dealer(*context, options.controller));
  DisplayLoop loop(options, *context, std::move(images), std::move(control), metrics.get());
  return loop.run(signals);
}

}  // namespace lfd::display
