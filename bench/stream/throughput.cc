// Rounds in turn, so that what else the machine does hits both.
#include "bench/stream/throughput.h"

#include <algorithm>

#include "base/large_blocks.h"
#include "base/log.h"

namespace lfd::bench {

int warm_up_of(int messages) { return messages / 8; }

Result<std::vector<ThroughputRow>> measure_throughput(const ThroughputOptions& options) {
  keep_large_blocks();  // as the display does
  std::vector<ThroughputRow> rows;
  for (const std::size_t bytes : options.image_bytes) {
    ThroughputRow row{bytes, std::max(static_cast<int>(options.round_bytes / bytes), 32), {}, {}, {}, {}};
    log::info("throughput: {} rounds of {} messages of {} bytes, in turn", options.rounds, row.images, bytes);
    const double gigabytes = static_cast<double>(bytes) * (row.images - warm_up_of(row.images)) / 1e9;
    std::vector<double> channel, keyed, library, ratio;
    for (int round = 0; round < options.rounds; ++round) {
      LFD_TRY(const double library_s, plain_pair_seconds(bytes, row.images));
      LFD_TRY(const double channel_s, images_pair_seconds(bytes, row.images, false));
      LFD_TRY(const double keyed_s, images_pair_seconds(bytes, row.images, true));
      library.push_back(gigabytes / library_s);
      channel.push_back(gigabytes / channel_s);
      keyed.push_back(gigabytes / keyed_s);
      ratio.push_back(library_s / channel_s);
    }
    row.channel_gb_s = spread_of(std::move(channel));
    row.keyed_gb_s = spread_of(std::move(keyed));
    row.library_gb_s = spread_of(std::move(library));
    row.ratio = spread_of(std::move(ratio));
    rows.push_back(row);
  }
  return rows;
}

}  // namespace lfd::bench
