// Listens to a show without taking part: hears every update, begin and swap that a controller publishes, across its
// lives.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/clock.h"
#include "base/result.h"
#include "proto/wire/socket.h"

namespace lfd::bench {

class Listener {
 public:
  // `state_endpoint` is fixed by the deployment; the controller may come later, and come again.
  static Result<std::unique_ptr<Listener>> open(const std::string& state_endpoint);

  // Everything that has arrived, in its order, and when it did, however late it is asked for; `on_session` before the
  // first message of another life of the controller.
  void hear(const std::function<void()>& on_session,
            const std::function<void(const proto::Envelope&, Clock::time_point at)>& on_message);

 private:
  struct Heard {
    proto::Envelope envelope;
    Clock::time_point at;
  };

  explicit Listener(std::unique_ptr<wire::Context> context, wire::Socket socket)
      : context_(std::move(context)), thread_([this, own = std::move(socket)](const std::stop_token& stop) mutable {
          listen(std::move(own), stop);
        }) {}
  void listen(wire::Socket socket, const std::stop_token& stop);  // on thread_

  std::unique_ptr<wire::Context> context_;
  std::uint64_t session_ = 0;
  std::mutex mutex_;  // guards heard_
  std::vector<Heard> heard_;
  std::jthread thread_;
};

}  // namespace lfd::bench
