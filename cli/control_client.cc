// Requests over a dealer socket.
#include "cli/control_client.h"

#include <algorithm>

#include "base/log.h"
#include "proto/wire/poll.h"

namespace lfd {
namespace {

// The state of a Follow travels as the payload.
proto::Reply whole_reply(const wire::Message& message) {
  proto::Reply reply = message.envelope.reply();
  if (!reply.has_follow()) return reply;
  const std::span<const std::byte> bytes = message.payload.bytes();
  if (!reply.mutable_follow()->mutable_snapshot()->ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
    reply.clear_follow();
    reply.set_error("the controller's state cannot be read");
  }
  return reply;
}

}  // namespace

Result<ControlClient> ControlClient::connect(const std::string& endpoint, const std::string& key_file) {
  LFD_TRY(auto context, wire::open_context(key_file));
  LFD_TRY(wire::Socket socket, wire::connect_dealer(*context, endpoint));
  return ControlClient(endpoint, std::move(context), std::move(socket));
}

ControlClient::ControlClient(std::string endpoint, std::unique_ptr<wire::Context> context, wire::Socket socket)
    : endpoint_(std::move(endpoint)), context_(std::move(context)), socket_(std::move(socket)) {}

Error ControlClient::no_answer() {
  const std::string why = socket_.trouble();
  return Error(fmt::format("no controller answers at {}{}{}", endpoint_, why.empty() ? "" : ": ", why));
}

Result<std::uint64_t> ControlClient::send(proto::Request request, Clock::duration at_most) {
  constexpr auto kSure = std::chrono::seconds(1);  // after which a refusal is taken for an answer
  const auto begin = Clock::now(), deadline = begin + at_most;
  request.set_id(++last_id_);
  proto::Envelope envelope;
  *envelope.mutable_request() = std::move(request);
  while (true) {
    const Status sent = socket_.send(envelope);
    if (sent) return last_id_;
    const bool is_refused = !socket_.trouble().empty() && Clock::now() >= begin + kSure;
    if (is_refused || Clock::now() >= deadline) return no_answer();
    wire::wait({&socket_}, {}, std::chrono::milliseconds(10));  // connections are made in the background
  }
}

std::optional<proto::Reply> ControlClient::receive(std::uint64_t id, Clock::duration at_most) {
  const auto deadline = Clock::now() + at_most;
  while (true) {
    while (auto message = socket_.receive()) {
      if (message->envelope.has_refused()) {
        proto::Reply reply;
        reply.set_error(message->envelope.refused().reason());
        return reply;
      }
      if (message->envelope.has_reply() && message->envelope.reply().id() == id) return whole_reply(*message);
    }
    const auto now = Clock::now();
    if (now >= deadline) return std::nullopt;
    wire::wait({&socket_}, {}, deadline - now);
  }
}

Result<proto::Reply> ControlClient::ask(const proto::Request& request, Clock::duration at_most) {
  constexpr auto kLook = std::chrono::milliseconds(20);  // less than it takes to start a controller anew
  const auto deadline = Clock::now() + at_most;
  LFD_TRY(const std::uint64_t id, send(request, at_most));
  std::optional<proto::Reply> reply;
  while (!reply && Clock::now() < deadline) {
    reply = receive(id, std::min<Clock::duration>(kLook, deadline - Clock::now()));
    if (reply || wire::is_connected(socket_)) continue;
    reply = receive(id, {});  // its last words
    if (!reply) return Error(fmt::format("the controller at {} has gone before it answered", endpoint_));
  }
  if (!reply) return no_answer();
  if (!reply->error().empty()) return Error(reply->error());
  return *reply;
}

Status ControlClient::quit(Clock::duration at_most) {
  constexpr auto kLook = std::chrono::milliseconds(50);
  const auto deadline = Clock::now() + at_most;
  proto::Request request;
  request.mutable_quit();
  LFD_TRY(const std::uint64_t id, send(std::move(request), at_most));
  while (Clock::now() < deadline) {
    if (const auto reply = receive(id, kLook)) return reply->error().empty() ? Status() : Error(reply->error());
    if (!wire::is_connected(socket_)) return {};
  }
  return Error(fmt::format("the controller at {} was asked to end and does not", endpoint_));
}

}  // namespace lfd
