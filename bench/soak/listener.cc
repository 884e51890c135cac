// A subscriber on a thread of its own.
#include "bench/soak/listener.h"

#include <utility>

#include "proto/wire/poll.h"

namespace lfd::bench {
namespace {

constexpr auto kPatience = std::chrono::milliseconds(100);  // to be told to stop

}  // namespace

Result<std::unique_ptr<Listener>> Listener::open(const std::string& state_endpoint) {
  auto context = std::make_unique<wire::Context>();
  LFD_TRY(wire::Socket socket, wire::connect_subscriber(*context, state_endpoint));
  return std::unique_ptr<Listener>(new Listener(std::move(context), std::move(socket)));
}

void Listener::listen(wire::Socket socket, const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    wire::wait({&socket}, {}, kPatience);
    while (auto message = socket.receive()) {
      const std::lock_guard lock(mutex_);
      heard_.push_back({std::move(message->envelope), Clock::now()});
    }
  }
}

void Listener::hear(const std::function<void()>& on_session,
                    const std::function<void(const proto::Envelope&, Clock::time_point at)>& on_message) {
  std::vector<Heard> heard;
  {
    const std::lock_guard lock(mutex_);
    heard.swap(heard_);
  }
  for (const auto& [envelope, at] : heard) {
    if (envelope.session() != session_) {
      session_ = envelope.session();
      on_session();
    }
    on_message(envelope, at);
  }
}

}  // namespace lfd::bench
