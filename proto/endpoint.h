// ZeroMQ endpoints as people write them: tcp://host:port or ipc://path.
#pragma once

#include <string_view>

#include "base/result.h"

namespace lfd {

// Accepts tcp://HOST:PORT (HOST a name, an IPv4 address, * or an IPv6 address in brackets; PORT 1 to 65535, or * for
// one that is chosen freely) and ipc://PATH (at most 107 bytes: the system's limit). The error says what is wrong.
Status validate_endpoint(std::string_view endpoint);

// Of valid endpoints, those that a socket can listen at: ZeroMQ looks up no names then, but knows the interfaces of the
// machine, and our sockets are of IPv4. Refused is a host that is neither a number nor can be an interface; whether
// that one is there is found when it is bound.
Status validate_bound_endpoint(std::string_view endpoint);

// True where the text fixes one place that only one socket can be bound to: no port "*".
bool is_fixed_endpoint(std::string_view endpoint);

}  // namespace lfd
