// Hears why connections of a socket do not come about.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <zmq.hpp>

namespace lfd::wire {

class Handshakes {
 public:
  struct Side {
    bool binds = false;  // it waits for peers
    bool has_keys = false;
  };

  // Listens to `socket`, which must be of the same context and used on the same thread.
  Handshakes(zmq::context_t& context, zmq::socket_t& socket, Side side);

  // Takes in what has happened; what was new of it, for a person: the last failure.
  std::optional<std::string> take_failure();

  // Why there is no connection, as far as is known; empty: nothing speaks against one.
  const std::string& last_failure() const { return last_failure_; }

 private:
  Side side_;
  zmq::socket_t events_;
  std::string last_failure_;
};

}  // namespace lfd::wire
