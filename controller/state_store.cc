// Numbered changes of the state.
#include "controller/state_store.h"

#include <algorithm>

#include "base/check.h"
#include "proto/state.h"

namespace lfd::controller {

StateStore::StateStore() : hasher_(state_), hashes_{hasher_.hash()} {}

proto::Update StateStore::change(proto::Update update) {
  update.set_sequence(state_.sequence() + 1);
  const Status applied = apply_update(state_, update);
  LFD_CHECK(applied, applied.error().message());
  hasher_.updated(state_, update);
  std::string hash = hasher_.hash();
  if (hash != hashes_.back()) hashes_.push_back(std::move(hash));
  if (hashes_.size() > kRemembered + 1) hashes_.pop_front();
  return update;
}

bool StateStore::remembers(std::string_view hash) const { return std::ranges::find(hashes_, hash) != hashes_.end(); }

}  // namespace lfd::controller
