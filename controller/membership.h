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
  std::string user;             // whose key it joined with; empty: without keys
  std::uint64_t process = 0;
  std::optional<Clock::time_point> last_heard;  // absent until it has been welcomed
  Clock::time_point last_word;                  // likewise, but from its join on

  // Another process that wants to come under this name, and since when; the name is its own once this peer has been
  // silent for as long as a peer that lives would not be.
  struct Rival {
    std::uint64_t process = 0;
    Clock::time_point since;
  };
  std::optional<Rival> rival;

  bool lives() const { return phase == Phase::kJoining || phase == Phase::kReady; }
};

class Membership {
 public:
  struct Rules {
    std::string version;           // peers of another are refused
    std::string calibration_hash;  // peers started with another are refused, and nodes that name none
    std::vector<std::string> nodes;
    Clock::duration patience;   // a peer silent for longer is out
    Clock::duration heartbeat;  // how often a peer that lives is heard
  };

  explicit Membership(Rules rules);

  // The peer's name, or the reason why it is refused. A peer that joins again from where it lives is accepted again; so
  // is the same process from a new address (it reconnected), and whoever comes under the name of one that has not been
  // welcomed yet. Another process under the name of a living peer is not answered (absent) and asks again: it takes the
  // place once nothing has been heard of the other for kHeartbeatsOfDoubt, as after a crash and a quick restart, and is
  // refused once something has. `user`: whose key it came with.
  Result<std::optional<std::string>> join(const proto::Join& join, const std::string& address, Clock::time_point now,
                                          const std::string& user = {});
  static constexpr int kHeartbeatsOfDoubt = 2;
  static constexpr int kGoneDisplays = 8;  // that are remembered: any number of names may come and go

  // Whose address it is, where it is not this user's: an address is what a peer calls itself, and free for others once
  // its connection is gone. The peer that joined from there may be out by now.
  const Peer* other_at(const std::string& address, const std::string& user) const;

  // The peer has been sent its Welcome: from now on it has to be heard.
  void welcomed(const std::string& name, Clock::time_point now);

  // Something came from this address. A peer that was put out for its silence is back by that (as joining: it has
  // missed updates).
  enum class Heard { kStranger, kMember, kBack };
  Heard heard(const std::string& address, Clock::time_point now);

  // The peer at `address` holds the state of this hash (empty: none yet). `known`: the hash is one of ours. A node is
  // ready by that; a display needs no state.
  void holds(const std::string& address, const std::string& state_hash, bool known);

  // The peer has been given other modules: it is not ready until it says that it can draw them.
  void reassigned(const std::string& name);

  // The peer at `address` goes of its own accord; its name, if it lived.
  std::optional<std::string> leave(const std::string& address);

  // Puts out whoever was silent for longer than the patience; their names.
  std::vector<std::string> expire(Clock::time_point now);

  Clock::duration patience() const { return rules_.patience; }
  const Peer* find(const std::string& name) const;
  const Peer* at(const std::string& address) const;
  const Peer* display() const;             // the living one
  std::vector<const Peer*> peers() const;  // all that the deployment names, and the display; also a few that went
  std::vector<std::string> ready_nodes() const;

 private:
  void forget_displays();
  Status check(const proto::Join& join) const;
  // Whether it may come now; absent: not decided yet.
  Result<bool> may_take_name(const proto::Join& join, const std::string& address, Clock::time_point now);
  Peer* living_of(const proto::Join& join);

  Rules rules_;
  std::map<std::string, Peer> peers_;  // by name
};

}  // namespace lfd::controller
