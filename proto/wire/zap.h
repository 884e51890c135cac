// Decides who is let in when a connection is made: the ZeroMQ Authentication Protocol (RFC 27) without its sockets.
#pragma once

#include <string>
#include <vector>

#include "proto/key_files.h"

namespace lfd::wire {

// Who listens at an endpoint. With keys, whoever connects makes sure that it is that one, and the controller lets in
// every member, the display nodes alone.
enum class Listener { kController, kDisplay };

// The domain of the protocol that sockets of such a listener are in.
const char* zap_domain(Listener listener);

struct ZapAnswer {
  std::vector<std::string> frames;  // of the reply
  std::string refusal;              // for the log; empty: it is let in
};

// The answer to a request's frames. The user that messages then come from is the member's name. `allowed` decides by
// the public key; whatever is not as it should be is refused.
ZapAnswer answer_zap(const std::vector<std::string>& request, const AllowList& allowed);

}  // namespace lfd::wire
