// How long a peer that joins waits where it is refused for now.
#pragma once

#include <algorithm>
#include <optional>

#include "base/clock.h"
#include "proto/wire.pb.h"

namespace lfd {

// Absent: it is refused for good. Nobody is made to wait for longer than 10 s.
inline std::optional<Clock::duration> try_again_after(const proto::Refused& refused) {
  if (refused.try_again_ms() == 0) return std::nullopt;
  return std::min<Clock::duration>(std::chrono::milliseconds(refused.try_again_ms()), std::chrono::seconds(10));
}

}  // namespace lfd
