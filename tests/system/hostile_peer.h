// A peer that means no good: it sends what it likes to the endpoints of a cluster, as fast as it can.
#pragma once

#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "proto/key_files.h"
#include "proto/wire.pb.h"
#include "tests/system/raw_peer.h"

namespace lfd::harness {

// Where a cluster listens, and what anybody can have learned of it.
struct Target {
  std::string control, state, bulk, images;
  std::string calibration_hash = {};
  std::uint64_t left_process = 0;  // of node "left"
  std::uint64_t frame = 0;         // a recent one

  std::vector<std::string> all() const { return {control, state, bulk, images}; }
};

// Keys of members that mean no good; null where the cluster works without.
struct StolenKeys {
  const KeyRing* control = nullptr;  // opens the controller
  const KeyRing* images = nullptr;   // opens the display, for images of a node that the deployment does not have
};

// Bytes that are no protocol, and greetings that are nearly right. At how many of the four endpoints they arrived: it
// greets the last of them, and hangs up for the answer.
int send_garbage(const Target& target, std::mt19937& random);

// A right greeting without a key, and then frames that are no messages: garbage, truncated envelopes, too many parts,
// parts that are larger than anything may be, envelopes that would grow when parsed. At how many endpoints the greeting
// was returned: nowhere where there are keys, and then no frame is sent.
int send_bad_frames(const Target& target, std::mt19937& random);

// Of those what the message library lets a peer send, through a connection that is in order: with keys too.
void send_bad_messages(const Target& target, std::mt19937& random, const StolenKeys& keys);

// What a peer of the cluster could have said: the words of node "left" again, joins of ever new displays, a flood of
// joins and requests whose answers are not read, images of who never greeted and of who takes another's name.
void send_words_of_others(const Target& target, const StolenKeys& keys);

// Connections that are held, every second of them with a right greeting.
std::vector<RawPeer> hold_connections(const Target& target, int count);

}  // namespace lfd::harness
