// Endpoints of the loopback interface that nobody uses at the moment.
#pragma once

#include <string>

namespace lfd::bench {

// "tcp://127.0.0.1:PORT". Somebody else may take it before it is bound.
std::string free_endpoint();

}  // namespace lfd::bench
