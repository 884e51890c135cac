// What a Socket is made of; only the sources of this folder see it.
#pragma once

#include <unistd.h>

#include <zmq.hpp>

#include "base/clock.h"
#include "proto/wire/handshakes.h"
#include "proto/wire/socket.h"
#include "proto/wire/zap_handler.h"

namespace lfd::wire {

struct Context::Transport {
  zmq::context_t zmq{1};
  std::optional<KeyRing> keys;
  std::optional<ZapHandler> handler;  // wherever there are keys
};

struct Socket::Transport {
  zmq::socket_t zmq;
  zmq::socket_type type;
  bool names_users = false;              // bound, with keys
  std::optional<Handshakes> handshakes;  // of dealers, and of what is bound with keys
  std::string endpoint;
  Limits limits;
  std::uint64_t refused = 0, lost = 0;
  std::optional<Clock::time_point> last_warning;
  std::string ipc_file;  // of a bound ipc endpoint: ZeroMQ leaves it behind

  std::size_t most_sent_bytes() const {
    return static_cast<std::size_t>(limits.max_sent_part_bytes > 0 ? limits.max_sent_part_bytes
                                                                   : limits.max_part_bytes);
  }

  ~Transport() {
    // Before its listener goes: the library's own thread would wait for it for ever, and nothing would be sent any
    // more.
    if (handshakes) ::zmq_socket_monitor(zmq.handle(), nullptr, 0);
    if (!ipc_file.empty()) ::unlink(ipc_file.c_str());
  }
};

}  // namespace lfd::wire
