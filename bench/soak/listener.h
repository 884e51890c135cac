// Listens to a show without taking part: hears every update, begin and swap that a controller publishes, across its
// lives.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/result.h"
#include "proto/wire/socket.h"

namespace lfd::bench {

class Listener {
 public:
  // `state_endpoint` is fixed by the deployment; the controller may come later, and come again.
  static Result<std::unique_ptr<Listener>> open(const std::string& state_endpoint);

  // Everything that has arrived, in its order; `on_session` before the first message of another life of the controller.
  void hear(const std::function<void()>& on_session, const std::function<void(const proto::Envelope&)>& on_message);

 private:
  explicit Listener(std::unique_ptr<wire::Context> context, wire::Socket socket)
      : context_(std::move(context)), socket_(std::move(socket)) {}

  std::unique_ptr<wire::Context> context_;
  wire::Socket socket_;
  std::uint64_t session_ = 0;
};

}  // namespace lfd::bench
