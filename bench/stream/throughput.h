// The images channel side by side with what the message library alone reaches, between two processes.
#pragma once

#include <cstddef>
#include <vector>

#include "base/result.h"
#include "bench/common/spread.h"

namespace lfd::bench {

struct ThroughputOptions {
  std::vector<std::size_t> image_bytes{std::size_t{2} << 20, std::size_t{3} << 20};
  int rounds = 15;                                 // of each, in turn
  std::size_t round_bytes = std::size_t{2} << 30;  // at least so much travels in each
};

struct ThroughputRow {
  std::size_t image_bytes = 0;
  int images = 0;                     // of a round
  Spread channel_gb_s, library_gb_s;  // 1e9 bytes of pixels in a second
  Spread keyed_gb_s;                  // the channel with keys (CURVE)
  Spread ratio;                       // channel over library, of the same round
};

// For each size: rounds in turn, over tcp on the loopback interface. The channel: a node's outbox and socket, the
// display's credits and assembly of frames of 16 modules, as the daemons use them; a message is an envelope and pixels
// that are not copied; with keys, what is sent is encrypted too. The library alone: a PAIR of sockets, messages of the
// same size, not copied either. Both processes are forks of this one: call it before any thread starts.
Result<std::vector<ThroughputRow>> measure_throughput(const ThroughputOptions& options);

// The first messages warm up: memory comes, connections get their windows.
int warm_up_of(int messages);

// plain_pair.cc: both ends of the library alone. Seconds that the messages after the warm-up took to be received.
Result<double> plain_pair_seconds(std::size_t message_bytes, int messages);
// images_pair.cc: both ends of the channel. Likewise.
Result<double> images_pair_seconds(std::size_t image_bytes, int images, bool keyed);

}  // namespace lfd::bench
