// Now, later or never.
#include "proto/refusal.h"

#include <algorithm>
#include <utility>

#include "base/log.h"

namespace lfd {

Result<bool> Refusals::heard(const proto::Refused& refused, bool is_member, const std::string& controller,
                             Clock::time_point& next_join) {
  if (refused.try_again_ms() > 0) {
    if (is_member) return false;
    const auto pause =
        std::min<Clock::duration>(std::chrono::milliseconds(refused.try_again_ms()), std::chrono::seconds(10));
    if (!std::exchange(waits_, true))
      log::warn("not let in yet: {}; joining again every {:.0f} ms", refused.reason(), milliseconds(pause));
    next_join = Clock::now() + pause;
    return false;
  }
  if (is_member || refused.not_a_member()) return is_member;
  return Error(fmt::format("{}: refused: {}", controller, refused.reason()));
}

}  // namespace lfd
