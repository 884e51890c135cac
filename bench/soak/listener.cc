// A subscriber.
#include "bench/soak/listener.h"

namespace lfd::bench {

Result<std::unique_ptr<Listener>> Listener::open(const std::string& state_endpoint) {
  auto context = std::make_unique<wire::Context>();
  LFD_TRY(wire::Socket socket, wire::connect_subscriber(*context, state_endpoint));
  return std::unique_ptr<Listener>(new Listener(std::move(context), std::move(socket)));
}

void Listener::hear(const std::function<void()>& on_session,
                    const std::function<void(const proto::Envelope&)>& on_message) {
  while (const auto message = socket_.receive()) {
    if (message->envelope.session() != session_) {
      session_ = message->envelope.session();
      on_session();
    }
    on_message(message->envelope);
  }
}

}  // namespace lfd::bench
