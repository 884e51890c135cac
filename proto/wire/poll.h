// Waiting for sockets and file descriptors at once.
#pragma once

#include <initializer_list>
#include <span>

#include "base/clock.h"
#include "proto/wire/socket.h"

namespace lfd::wire {

// Waits until a socket has something to receive, a descriptor (Wakeup, Mailbox, signalfd) is readable, a signal arrives
// or `at_most` has passed (negative: not at all). True where something is ready. Then receive() from every socket until
// it is empty.
bool wait(std::span<const Socket* const> sockets, std::span<const int> descriptors, Clock::duration at_most);

inline bool wait(std::initializer_list<const Socket*> sockets, std::initializer_list<int> descriptors,
                 Clock::duration at_most) {
  return wait(std::span(sockets.begin(), sockets.size()), std::span(descriptors.begin(), descriptors.size()), at_most);
}

// Of a dealer: whether its peer is there, as far as the transport knows.
bool is_connected(const Socket& socket);

}  // namespace lfd::wire
