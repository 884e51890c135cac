// Who belongs to the cluster: joins are accepted or refused with a reason, silent peers are put out. Told events and
// the time.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/clock.h"
#include "base/result.h"
#include "proto/wire.pb.h"

namespace lfd::controller {

enum class Phase {
  kAbsent,   // never joined
  kJoining,  // accepted, does not hold the state yet
  kReady,    // holds the state: takes part in frames
  kOut,      // left, or silent for too long; may join again
};

const char* name_of(Phase phase);

struct Peer {
  proto::Role role = proto::NODE;
  std::string name;
  Phase phase = Phase::kAbsent;
  std::string address;  // of the control channel; empty where it is absent or has left
  std::string state_hash;
  std::string images_endpoint;  // of a display
  std::uint64_t process = 0;
  std::optional<Clock::time_point> last_heard;  // absent until it has been welcomed

  bool lives() const { return phase == Phase::kJoining || phase == Phase::kReady; }
};

class Membership {
 public:
  struct Rules {
    std::string version;           // peers of another are refused
    std::string calibration_hash;  // peers started with another are refused
    std::vector<std::string> nodes;
    Clock::duration patience;  // a peer silent for longer is out
  };

  explicit Membership(Rules rules);

  // The peer's name, or the reason why it is refused. A peer that joins again from where it lives is accepted again; so
  // is the same process from a new address (it reconnected), and whoever comes under the name of one that has not been
  // welcomed yet.
  Result<std::string> join(const proto::Join& join, const std::string& address);

  // The peer has been sent its Welcome: from now on it has to be heard.
  void welcomed(const std::string& name, Clock::time_point now);

  // Something came from this address. A peer that was put out for its silence is back by that (as joining: it has
  // missed updates).
  enum class Heard { kStranger, kMember, kBack };
  Heard heard(const std::string& address, Clock::time_point now);

  // The peer at `address` holds the state of this hash (empty: none yet). `known`: the hash is one of ours. A node is
  // ready by that; a display needs no state.
  void holds(const std::string& address, const std::string& state_hash, bool known);

  // The peer at `address` goes of its own accord; its name, if it lived.
  std::optional<std::string> leave(const std::string& address);

  // Puts out whoever was silent for longer than the patience; their names.
  std::vector<std::string> expire(Clock::time_point now);

  const Peer* find(const std::string& name) const;
  const Peer* at(const std::string& address) const;
  const Peer* display() const;             // the living one
  std::vector<const Peer*> peers() const;  // all that the deployment names, and displays that ever joined
  std::vector<std::string> ready_nodes() const;

 private:
  Status check(const proto::Join& join, const std::string& address) const;

  Rules rules_;
  std::map<std::string, Peer> peers_;  // by name
};

}  // namespace lfd::controller
