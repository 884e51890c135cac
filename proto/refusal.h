// What a peer does where the controller refuses it.
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

// What a node or display does about a refusal. A controller that was started anew answers every heartbeat that it hears
// of a peer it does not know: the join that the first answer brings about stands.
enum class OnRefusal { kIgnore, kWait, kJoinAgain, kEnd };
inline OnRefusal on_refusal(const proto::Refused& refused, bool is_member) {
  if (try_again_after(refused)) return is_member ? OnRefusal::kIgnore : OnRefusal::kWait;  // of an earlier join
  if (is_member) return OnRefusal::kJoinAgain;
  return refused.not_a_member() ? OnRefusal::kIgnore : OnRefusal::kEnd;
}

}  // namespace lfd
