// What a Socket is made of; only the sources of this folder see it.
#pragma once

#include <unistd.h>

#include <zmq.hpp>

#include "base/clock.h"
#include "proto/wire/socket.h"

namespace lfd::wire {

struct Context::Transport {
  zmq::context_t zmq{1};
};

struct Socket::Transport {
  zmq::socket_t zmq;
  zmq::socket_type type;
  std::string endpoint;
  Limits limits;
  std::uint64_t refused = 0, lost = 0;
  std::optional<Clock::time_point> last_warning;
  std::string ipc_file;  // of a bound ipc endpoint: ZeroMQ leaves it behind

  ~Transport() {
    if (!ipc_file.empty()) ::unlink(ipc_file.c_str());
  }
};

}  // namespace lfd::wire
