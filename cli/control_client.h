// A conversation with a running controller: requests and their replies.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "base/clock.h"
#include "base/result.h"
#include "proto/wire/socket.h"

namespace lfd {

class ControlClient {
 public:
  // key_file: whose key to come with; empty: without. Errors: the endpoint or the key cannot be read.
  static Result<ControlClient> connect(const std::string& endpoint, const std::string& key_file = {});

  // Sends a request, once the controller is there; its number is filled in and returned. Errors: nobody is there in
  // time.
  Result<std::uint64_t> send(proto::Request request, Clock::duration at_most);

  // The reply to request `id`; absent where none has come in time. Replies to others are left out.
  std::optional<proto::Reply> receive(std::uint64_t id, Clock::duration at_most);

  // Asks the controller to end. Its reply may be lost with the connection: that it has gone is an answer too.
  Status quit(Clock::duration at_most);

  // Both. A reply that tells an error is an error, and so is a connection that is lost before it: another controller at
  // the same address does not know of the request.
  Result<proto::Reply> ask(const proto::Request& request, Clock::duration at_most);

 private:
  ControlClient(std::string endpoint, std::unique_ptr<wire::Context> context, wire::Socket socket);

  Error no_answer();

  std::string endpoint_;
  std::unique_ptr<wire::Context> context_;
  wire::Socket socket_;
  std::uint64_t last_id_ = 0;
};

}  // namespace lfd
