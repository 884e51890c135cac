// The state that the cluster shows, as the controller holds it: every change is numbered, every recent state known by
// its hash.
#pragma once

#include <deque>
#include <string>
#include <string_view>

#include "proto/state_hasher.h"
#include "proto/wire.pb.h"

namespace lfd::controller {

class StateStore {
 public:
  StateStore();

  const proto::State& state() const { return state_; }
  const std::string& hash() const { return hashes_.back(); }
  std::uint64_t sequence() const { return state_.sequence(); }

  // Numbers `update`, applies it and returns it as it is to be published. It must fit the state (our own updates do).
  proto::Update change(proto::Update update);

  // Whether this is the hash of the state or of one of the kRemembered before it. A node that reports such a hash
  // follows the updates; another holds something we never said.
  bool remembers(std::string_view hash) const;

  // By all changes so far: a change costs what it touches.
  std::uint64_t hashed_bytes() const { return hasher_.hashed_bytes(); }

  static constexpr std::size_t kRemembered = 256;

 private:
  proto::State state_;
  StateHasher hasher_;              // of state_
  std::deque<std::string> hashes_;  // the newest last
};

}  // namespace lfd::controller
