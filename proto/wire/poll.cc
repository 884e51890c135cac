// zmq_poll over sockets and descriptors.
#include "proto/wire/poll.h"

#include <algorithm>
#include <cerrno>
#include <vector>

#include "proto/wire/transport.h"

namespace lfd::wire {

bool wait(std::span<const Socket* const> sockets, std::span<const int> descriptors, Clock::duration at_most) {
  std::vector<zmq::pollitem_t> items;
  for (const Socket* socket : sockets) items.push_back({socket->transport().zmq.handle(), 0, ZMQ_POLLIN, 0});
  for (const int descriptor : descriptors) items.push_back({nullptr, descriptor, ZMQ_POLLIN, 0});
  try {
    const auto patience = std::max(std::chrono::ceil<std::chrono::milliseconds>(at_most), std::chrono::milliseconds(0));
    return zmq::poll(items, patience) > 0;
  } catch (const zmq::error_t& error) {
    LFD_CHECK(error.num() == EINTR, error.what());
    return false;
  }
}

bool is_connected(const Socket& socket) {
  return (socket.transport().zmq.get(zmq::sockopt::events) & ZMQ_POLLOUT) != 0;
}

}  // namespace lfd::wire
