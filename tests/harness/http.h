// The least of HTTP: what a test fetches from a server on this machine.
#pragma once

#include <string>

#include "base/result.h"

namespace lfd::harness {

// The body of GET PATH from IPv4 ADDRESS:PORT. Errors: nobody listens there; another answer than 200.
Result<std::string> http_get(const std::string& address, int port, const std::string& path);

}  // namespace lfd::harness
