// What ZeroMQ does where nothing else is to be done: a PAIR of sockets, one part a message, no copies of our own.
#include <chrono>
#include <string>
#include <vector>

#include <zmq.hpp>

#include "base/clock.h"
#include "bench/stream/throughput.h"
#include "bench/stream/two_processes.h"

namespace lfd::bench {
namespace {

constexpr int kPatience_ms = 30000;
constexpr std::size_t kBuffers = 32;  // as the channel has: two frames of sixteen modules

void send_all(const std::string& endpoint, std::size_t message_bytes, int messages) {
  const std::vector<std::string> buffers(kBuffers, std::string(message_bytes, 'x'));
  zmq::context_t context(1);
  zmq::socket_t socket(context, zmq::socket_type::pair);
  socket.connect(endpoint);
  for (int i = 0; i < messages; ++i) {
    const std::string& bytes = buffers[static_cast<std::size_t>(i) % kBuffers];
    zmq::message_t message(const_cast<char*>(bytes.data()), bytes.size(), [](void*, void*) {});
    socket.send(message, zmq::send_flags::none);
  }
  zmq::message_t end;
  static_cast<void>(socket.recv(end));  // until the other process has all
}

}  // namespace

Result<double> plain_pair_seconds(std::size_t message_bytes, int messages) {
  const auto receive = [&](const auto& say) -> Result<double> {
    try {
      zmq::context_t context(1);
      zmq::socket_t socket(context, zmq::socket_type::pair);
      socket.set(zmq::sockopt::rcvtimeo, kPatience_ms);
      socket.set(zmq::sockopt::linger, 0);
      socket.bind("tcp://127.0.0.1:*");
      say(socket.get(zmq::sockopt::last_endpoint));
      Clock::time_point first{};
      for (int i = 0; i < messages; ++i) {
        zmq::message_t message;
        if (!socket.recv(message)) return Error("no message comes");
        if (message.size() != message_bytes) return Error("a message of another size");
        if (i + 1 == warm_up_of(messages)) first = Clock::now();
      }
      return milliseconds(Clock::now() - first) / 1000;
    } catch (const zmq::error_t& error) {
      return Error(error.what());
    }
  };
  return between_two_processes(receive, [&](const std::string& endpoint) {
    try {
      send_all(endpoint, message_bytes, messages);
    } catch (const zmq::error_t&) {  // the other side says that nothing comes
    }
  });
}

}  // namespace lfd::bench
