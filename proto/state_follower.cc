// Updates and gaps.
#include "proto/state_follower.h"

#include "base/log.h"

namespace lfd {

void StateFollower::snapshot_came(const proto::State& state) {
  if (state_ && !gap_ && state.sequence() <= state_->sequence()) return;
  state_ = std::make_shared<const proto::State>(state);
  hasher_.emplace(*state_);
  gap_ = false;
}

void StateFollower::update_came(const proto::Update& update) {
  if (!state_ || update.sequence() <= state_->sequence()) return;
  auto next = std::make_shared<proto::State>(*state_);
  if (const Status applied = apply_update(*next, update); !applied) {
    if (!gap_) log::info("update {} after {}: {}", update.sequence(), state_->sequence(), applied.error().message());
    gap_ = true;
    return;
  }
  hasher_->updated(*next, update);
  state_ = std::move(next);
}

void StateFollower::pulse_came(std::uint64_t last_sequence) {
  if (state_ && last_sequence > state_->sequence()) gap_ = true;
}

}  // namespace lfd
