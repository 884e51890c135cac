// The live table of a cluster: told every status and its time, it writes what a person watches.
#pragma once

#include <optional>
#include <string>

#include "base/clock.h"
#include "proto/wire.pb.h"

namespace lfd {

class WatchTable {
 public:
  // The controller has answered: the table.
  std::string answered(const proto::Status& status, Clock::time_point now);

  // It has not: since when, and the last table as far as `whole` wants it.
  std::string unanswered(Clock::time_point now, bool whole);

 private:
  double bytes_per_second(const proto::PeerStatus& peer, Clock::time_point now) const;  // negative: not known
  std::string rows(const proto::Status& status, Clock::time_point now) const;

  std::optional<proto::Status> last_;
  Clock::time_point last_at_{};
  std::optional<Clock::time_point> away_since_;
  std::string last_table_;
};

// Its largest passes with their milliseconds, the largest first: "ao 5.2, gbuffer 3.1".
std::string stages_text(const proto::PeerStatus& peer, std::size_t most);

// Nodes that a budget let choose, and what: a line each.
std::string choices_text(const proto::Status& status);

}  // namespace lfd
