// Envelopes over ZeroMQ sockets; its exceptions end here.
#include "proto/wire/socket.h"

#include <algorithm>
#include <array>
#include <cerrno>

#include "base/log.h"
#include "base/version.h"
#include "proto/wire/transport.h"

namespace lfd::wire {
namespace {

using namespace std::chrono_literals;

constexpr auto kWarningPause = 5s;
// Messages that one call looks at and leaves out: its caller has other things to do.
constexpr int kRefusedAtOnce = 64, kSubscriptionsAtOnce = 4096;

// A message that ends the life of its owner when the transport has done with it.
zmq::message_t without_copy(const Payload& payload) {
  auto* kept = new std::shared_ptr<const void>(payload.owner());
  const auto release = [](void*, void* hint) { delete static_cast<std::shared_ptr<const void>*>(hint); };
  return zmq::message_t(const_cast<std::byte*>(payload.bytes().data()), payload.size(), release, kept);
}

// The number stands first, so that one given in `envelope` itself prevails (Protobuf: the last one counts).
std::string stamped(const proto::Envelope& envelope) {
  proto::Envelope stamp;
  stamp.set_protocol(kProtocolVersion);
  std::string bytes = stamp.SerializeAsString();
  envelope.AppendToString(&bytes);
  return bytes;
}

enum class Sent { kYes, kFull, kNoPeer };

// The first part decides for the whole message: ZeroMQ refuses or takes all parts of it.
Sent send_parts(zmq::socket_t& socket, const std::string& peer, const std::string& envelope, const Payload& payload) {
  const auto more = [](bool is_more) {
    return is_more ? zmq::send_flags::dontwait | zmq::send_flags::sndmore : zmq::send_flags::dontwait;
  };
  try {
    if (!peer.empty() && !socket.send(zmq::buffer(peer), more(true))) return Sent::kFull;
    if (!socket.send(zmq::buffer(envelope), more(!payload.empty()))) return Sent::kFull;
    if (!payload.empty() && !socket.send(without_copy(payload), more(false))) return Sent::kFull;
    return Sent::kYes;
  } catch (const zmq::error_t& error) {
    if (error.num() == EHOSTUNREACH) return Sent::kNoPeer;
    if (error.num() == EINTR) return Sent::kFull;
    LFD_CHECK(false, error.what());
  }
}

Status check_size(const Socket::Transport& socket, std::size_t envelope_bytes, std::size_t payload_bytes) {
  for (const std::size_t bytes : {envelope_bytes, payload_bytes}) {
    if (bytes > socket.most_sent_bytes()) {
      return Error(fmt::format("{}: {} bytes are too many to send; at most {} go", socket.endpoint, bytes,
                               socket.most_sent_bytes()));
    }
  }
  return {};
}

bool warning_is_due(Socket::Transport& socket) {
  const auto now = Clock::now();
  if (socket.last_warning && now - *socket.last_warning < kWarningPause) return false;
  socket.last_warning = now;
  return true;
}

void warn_now_and_then(Socket::Transport& socket, std::string_view what) {
  if (warning_is_due(socket))
    log::warn("{}: {} (so far {} refused, {} lost)", socket.endpoint, what, socket.refused, socket.lost);
}

void hear_of_handshakes(Socket::Transport& socket) {
  if (!socket.handshakes) return;
  const auto failure = socket.handshakes->take_failure();
  if (failure && warning_is_due(socket)) log::warn("{}: {}", socket.endpoint, *failure);
}

// All that is received of one message; `parts` beyond the third are counted but not kept.
struct Parts {
  std::array<zmq::message_t, 3> part;
  int count = 0;
};

std::optional<Parts> receive_parts(zmq::socket_t& socket) {
  Parts parts;
  try {
    for (;;) {
      zmq::message_t part;
      if (!socket.recv(part, zmq::recv_flags::dontwait)) return std::nullopt;
      const bool more = part.more();
      if (parts.count < 3) parts.part[parts.count] = std::move(part);
      ++parts.count;
      if (!more) return parts;
    }
  } catch (const zmq::error_t& error) {
    LFD_CHECK(error.num() == EINTR, error.what());
    return std::nullopt;
  }
}

// Subscriptions as they come in; nothing is decided by them. Everybody here subscribes to everything, a word of one
// byte: the library keeps whatever else is asked for until the connection ends, and lets nobody forbid it.
void hear_subscriptions(Socket::Transport& socket) {
  for (int i = 0; i < kSubscriptionsAtOnce; ++i) {
    const auto parts = receive_parts(socket.zmq);
    if (!parts) return;
    if (parts->part[0].size() <= 1) continue;
    ++socket.refused;
    warn_now_and_then(socket, "somebody subscribes to what is not published");
  }
}

// Who sent it, as the allow-list calls it. The library lets what the list says stand before what a peer says of itself;
// without keys, anybody could say anything.
std::string user_of(zmq::message_t& part) {
  const char* user = ::zmq_msg_gets(part.handle(), "User-Id");
  return user == nullptr ? "" : user;
}

// How long an envelope of this peer may be that has so many bytes.
std::size_t most_envelope_bytes(const Socket::Transport& socket, const std::string& peer, std::size_t bytes,
                                const std::function<bool(const std::string& peer)>& is_known) {
  const Limits& limits = socket.limits;
  const std::int64_t most = limits.max_envelope_bytes > 0 ? limits.max_envelope_bytes : limits.max_part_bytes;
  const bool is_short = bytes <= static_cast<std::size_t>(kShort_bytes);
  const bool is_stranger = !is_short && is_known && !is_known(peer);
  return static_cast<std::size_t>(is_stranger ? std::min(most, kShort_bytes) : most);
}

// The message, or why it is none.
Result<Message> read(Parts& parts, const Socket::Transport& socket,
                     const std::function<bool(const std::string& peer)>& is_known) {
  const bool from_router = socket.type == zmq::socket_type::router;
  Message message;
  const int envelope_at = from_router ? 1 : 0;
  if (from_router) message.peer = parts.part[0].to_string();
  if (parts.count < envelope_at + 1 || parts.count > envelope_at + 2) {
    return Error(fmt::format("a message of {} parts; one or two are expected", parts.count - envelope_at));
  }
  zmq::message_t& envelope = parts.part[envelope_at];
  if (const std::size_t most = most_envelope_bytes(socket, message.peer, envelope.size(), is_known);
      envelope.size() > most)
    return Error(fmt::format("an envelope of {} bytes; at most {} are read of this peer", envelope.size(), most));
  if (socket.names_users) {
    message.user = user_of(envelope);
    if (message.user.empty()) return Error("a message of nobody that the allow-list names");
  }
  if (!message.envelope.ParseFromArray(envelope.data(), static_cast<int>(envelope.size()))) {
    return Error("a message that cannot be parsed");
  }
  if (parts.count == envelope_at + 2) {
    const auto kept = std::make_shared<zmq::message_t>(std::move(parts.part[envelope_at + 1]));
    message.payload = Payload(kept, {static_cast<const std::byte*>(kept->data()), kept->size()});
  }
  return message;
}

}  // namespace

Socket::Socket(std::unique_ptr<Transport> transport) : transport_(std::move(transport)) {}
Socket::Socket(Socket&&) noexcept = default;
Socket& Socket::operator=(Socket&&) noexcept = default;
Socket::~Socket() = default;

const std::string& Socket::endpoint() const { return transport_->endpoint; }
std::uint64_t Socket::refused() const { return transport_->refused; }
std::uint64_t Socket::lost() const { return transport_->lost; }

void Socket::linger(std::chrono::milliseconds at_most) {
  transport_->zmq.set(zmq::sockopt::linger, static_cast<int>(at_most.count()));
}

Status Socket::send(const proto::Envelope& envelope, const Payload& payload) {
  LFD_CHECK(transport_->type == zmq::socket_type::dealer || transport_->type == zmq::socket_type::xpub,
            "only dealers and publishers send without naming a peer");
  const std::string bytes = stamped(envelope);
  LFD_TRY_STATUS(check_size(*transport_, bytes.size(), payload.size()));
  const bool publishes = transport_->type == zmq::socket_type::xpub;
  hear_of_handshakes(*transport_);
  if (publishes) hear_subscriptions(*transport_);
  if (send_parts(transport_->zmq, {}, bytes, payload) == Sent::kYes) return {};
  if (!publishes) {
    const std::string why = trouble();
    return Error(fmt::format("{}: not connected, or too much waits to be sent{}{}", transport_->endpoint,
                             why.empty() ? "" : ": ", why));
  }
  // One subscriber's queue is full: let that one miss the message rather than all of them.
  transport_->zmq.set(zmq::sockopt::xpub_nodrop, 0);
  send_parts(transport_->zmq, {}, bytes, payload);
  transport_->zmq.set(zmq::sockopt::xpub_nodrop, 1);
  ++transport_->lost;
  warn_now_and_then(*transport_, "a subscriber does not keep up and misses messages");
  return {};
}

Status Socket::send_to(const std::string& peer, const proto::Envelope& envelope, const Payload& payload) {
  LFD_CHECK(transport_->type == zmq::socket_type::router, "only routers send to one of many peers");
  if (peer.empty()) return Error(fmt::format("{}: no peer is named", transport_->endpoint));
  const std::string bytes = stamped(envelope);
  LFD_TRY_STATUS(check_size(*transport_, bytes.size(), payload.size()));
  switch (send_parts(transport_->zmq, peer, bytes, payload)) {
    case Sent::kYes:
      return {};
    case Sent::kFull:
      return Error(fmt::format("{}: too much waits to be sent to the peer", transport_->endpoint));
    case Sent::kNoPeer:
      break;
  }
  return Error(fmt::format("{}: no such peer, or it has left", transport_->endpoint));
}

std::string Socket::trouble() {
  hear_of_handshakes(*transport_);
  return transport_->handshakes ? transport_->handshakes->last_failure() : "";
}

std::optional<Message> Socket::receive(const std::function<bool(const std::string& peer)>& is_known) {
  const bool is_router = transport_->type == zmq::socket_type::router;
  hear_of_handshakes(*transport_);
  for (int refused = 0; refused < kRefusedAtOnce; ++refused) {
    auto parts = receive_parts(transport_->zmq);
    if (!parts) return std::nullopt;
    auto message = read(*parts, *transport_, is_known);
    if (!message) {
      ++transport_->refused;
      warn_now_and_then(*transport_, message.error().message());
      continue;
    }
    const proto::Envelope& envelope = message->envelope;
    if (envelope.protocol() == kProtocolVersion || envelope.has_refused()) return std::move(*message);
    ++transport_->refused;
    const std::string reason =
        fmt::format("a message of protocol {} is refused; protocol {} is spoken here (version {})", envelope.protocol(),
                    kProtocolVersion, kVersion);
    warn_now_and_then(*transport_, reason);
    if (!is_router) continue;
    proto::Envelope answer;
    answer.mutable_refused()->set_reason(reason);
    if (auto status = send_to(message->peer, answer); !status) log::debug("{}", status.error().message());
  }
  return std::nullopt;
}

}  // namespace lfd::wire
