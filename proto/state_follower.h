// Follows the numbered updates of the state; notices gaps. No sockets, no clock.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "proto/state.h"
#include "proto/state_hasher.h"

namespace lfd {

class StateFollower {
 public:
  // Absent until the first snapshot. What it points to never changes: an update makes a new state.
  const std::shared_ptr<const proto::State>& state() const { return state_; }
  // Of that state (state_hash); empty until there is one.
  std::string hash() const { return hasher_ ? hasher_->hash() : ""; }
  std::uint64_t sequence() const { return state_ ? state_->sequence() : 0; }

  // Numbers are missing: a snapshot must be asked for. Stays true until one has come.
  bool has_gap() const { return gap_; }

  void snapshot_came(const proto::State& state);
  // Applies an update; an older one than the state is passed over, a later one than the next opens a gap.
  void update_came(const proto::Update& update);
  // The controller says which update was its last.
  void pulse_came(std::uint64_t last_sequence);

 private:
  std::shared_ptr<const proto::State> state_;
  std::optional<StateHasher> hasher_;
  bool gap_ = false;
};

}  // namespace lfd
