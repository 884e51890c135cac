// The metronome of frames.
#include "controller/pacing.h"

#include <algorithm>

namespace lfd::controller {

Pacing::Pacing(double frames_per_second, bool idle)
    : interval_(frames_per_second > 0
                    ? std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / frames_per_second))
                    : Clock::duration::zero()) {
  if (idle) remaining_ = 0;
}

void Pacing::ask_for(std::uint64_t count) { remaining_ = count; }

bool Pacing::due(Clock::time_point now) const {
  if (!wants_frames()) return false;
  return !paced() || !next_ || now >= *next_;
}

void Pacing::begun(Clock::time_point now) {
  if (remaining_ && *remaining_ > 0) --*remaining_;
  // Steps of the metronome that passed while the nodes drew are left out, not made up for.
  const Clock::time_point planned = next_.value_or(now) + interval_;
  next_ = std::max(planned, now);
}

std::optional<Clock::time_point> Pacing::next() const { return paced() ? next_ : std::nullopt; }

}  // namespace lfd::controller
