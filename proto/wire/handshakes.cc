// Events of a socket's monitor.
#include "proto/wire/handshakes.h"

#include <atomic>
#include <cerrno>
#include <cstring>

#include "base/check.h"
#include "base/log.h"

namespace lfd::wire {
namespace {

constexpr int kHeard = ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL | ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL |
                       ZMQ_EVENT_HANDSHAKE_FAILED_AUTH | ZMQ_EVENT_HANDSHAKE_SUCCEEDED;

// Frame 1 of an event: its number and a value.
struct Event {
  std::uint16_t number = 0;
  std::uint32_t value = 0;
};

std::optional<Event> next_event(zmq::socket_t& events) {
  zmq::message_t frame;
  if (!events.recv(frame, zmq::recv_flags::dontwait)) return std::nullopt;
  Event event;
  if (frame.size() >= sizeof event.number + sizeof event.value) {
    const auto* bytes = static_cast<const char*>(frame.data());
    std::memcpy(&event.number, bytes, sizeof event.number);
    std::memcpy(&event.value, bytes + sizeof event.number, sizeof event.value);
  }
  while (frame.more()) {
    if (!events.recv(frame, zmq::recv_flags::dontwait)) break;
  }
  return event;
}

std::string explain(const Event& event, bool binds) {
  if (event.number == ZMQ_EVENT_HANDSHAKE_FAILED_AUTH)
    return "the key is refused: the listener's allow-list does not let it in here";
  if (event.value == ZMQ_PROTOCOL_ERROR_ZMTP_MECHANISM_MISMATCH) {
    return binds ? "a peer is refused: it comes without a key"
                 : "one side works with keys, the other without (see --key, and security { keys } of the deployment)";
  }
  return binds ? "a peer is refused: it does not speak as peers do, or takes this process for one of another key"
               : "the connection ends before it is made: the listener has no key, or another than the allow-list names";
}

}  // namespace

Handshakes::Handshakes(zmq::context_t& context, zmq::socket_t& socket, Side side)
    : side_(side), events_(context, zmq::socket_type::pair) {
  static std::atomic<std::uint64_t> count{0};
  const std::string place = fmt::format("inproc://lfd-handshakes-{}", count++);
  LFD_CHECK(::zmq_socket_monitor(socket.handle(), place.c_str(), kHeard) == 0, ::zmq_strerror(::zmq_errno()));
  events_.set(zmq::sockopt::rcvhwm, 0);  // at a limit, the library's own thread would wait for us
  events_.set(zmq::sockopt::linger, 0);
  events_.connect(place);
}

std::optional<std::string> Handshakes::take_failure() {
  std::optional<std::string> news;
  try {
    while (const auto event = next_event(events_)) {
      if (event->number == ZMQ_EVENT_HANDSHAKE_SUCCEEDED) {
        last_failure_.clear();
        continue;
      }
      // Who decides about keys has said so already.
      if (side_.binds && event->number == ZMQ_EVENT_HANDSHAKE_FAILED_AUTH) continue;
      // Without keys a connection that ends early says nothing more than that the other side has gone.
      if (!side_.has_keys && event->number == ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL) continue;
      last_failure_ = explain(*event, side_.binds);
      news = last_failure_;
    }
  } catch (const zmq::error_t& error) {
    LFD_CHECK(error.num() == EINTR, error.what());
  }
  return news;
}

}  // namespace lfd::wire
