// Envelopes over ZeroMQ sockets; its exceptions end here.
#include "proto/wire/socket.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <vector>

#include "base/log.h"
#include "base/version.h"
#include "proto/endpoint.h"
#include "proto/wire/owner.h"
#include "proto/wire/transport.h"

namespace lfd::wire {
namespace {

using namespace std::chrono_literals;

constexpr int kReconnectAfter_ms = 100;
constexpr int kReconnectAtMost_ms = 1000;  // the pause doubles up to this
constexpr int kHandshakeAtMost_ms = 5000;
constexpr auto kWarningPause = 5s;

void set_limits(zmq::socket_t& socket, zmq::socket_type type, const Limits& limits) {
  namespace option = zmq::sockopt;
  socket.set(option::linger, 0);
  socket.set(option::ipv6, 0);
  socket.set(option::maxmsgsize, limits.max_part_bytes);
  socket.set(option::sndhwm, limits.queued_messages);
  socket.set(option::rcvhwm, limits.queued_messages);
  socket.set(option::handshake_ivl, kHandshakeAtMost_ms);
  socket.set(option::reconnect_ivl, kReconnectAfter_ms);
  socket.set(option::reconnect_ivl_max, kReconnectAtMost_ms);
  socket.set(option::heartbeat_ivl, 0);  // peers have heartbeats of their own, which say more
  if (type == zmq::socket_type::router) socket.set(option::router_mandatory, 1);
  if (type == zmq::socket_type::dealer) socket.set(option::immediate, 1);
  if (type == zmq::socket_type::xpub) socket.set(option::xpub_nodrop, 1);
  if (type == zmq::socket_type::sub) socket.set(option::subscribe, "");
}

// ZeroMQ would silently take an ipc path away from its owner: ask first whether somebody listens there.
bool somebody_listens(const std::string& ipc_path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (ipc_path.empty() || ipc_path.size() >= sizeof(address.sun_path) || ipc_path[0] == '@') return false;
  std::memcpy(address.sun_path, ipc_path.data(), ipc_path.size());
  const int probe = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (probe < 0) return false;
  const bool connected = ::connect(probe, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
  ::close(probe);
  return connected;
}

Error taken(const std::string& endpoint) {
  const auto owner = owner_of(endpoint);
  if (!owner) return Error(fmt::format("{}: the address is in use by a process that cannot be seen", endpoint));
  return Error(fmt::format("{}: the address is in use by process {} ({})", endpoint, owner->process, owner->command));
}

using Attach = void (zmq::socket_t::*)(const std::string&);

Result<Socket> open(Context& context, zmq::socket_type type, const std::string& endpoint, const Limits& limits,
                    Attach attach) {
  const bool binds = attach == static_cast<Attach>(&zmq::socket_t::bind);
  LFD_TRY_STATUS(validate_endpoint(endpoint));
  const std::string ipc_file = binds && endpoint.starts_with("ipc://") ? endpoint.substr(6) : "";
  if (somebody_listens(ipc_file)) return taken(endpoint);
  try {
    auto made = std::make_unique<Socket::Transport>();
    made->zmq = zmq::socket_t(context.transport().zmq, type);
    made->type = type;
    made->limits = limits;
    set_limits(made->zmq, type, limits);
    (made->zmq.*attach)(endpoint);
    made->ipc_file = ipc_file;
    made->endpoint = binds ? made->zmq.get(zmq::sockopt::last_endpoint) : endpoint;
    return Socket(std::move(made));
  } catch (const zmq::error_t& error) {
    if (error.num() == EADDRINUSE) return taken(endpoint);
    return Error(fmt::format("{}: {}", endpoint, error.what()));
  }
}

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
    if (bytes > static_cast<std::size_t>(socket.limits.max_part_bytes)) {
      return Error(fmt::format("{}: {} bytes are too many to send; at most {} go", socket.endpoint, bytes,
                               socket.limits.max_part_bytes));
    }
  }
  return {};
}

void warn_now_and_then(Socket::Transport& socket, std::string_view what) {
  const auto now = Clock::now();
  if (socket.last_warning && now - *socket.last_warning < kWarningPause) return;
  socket.last_warning = now;
  log::warn("{}: {} (so far {} refused, {} lost)", socket.endpoint, what, socket.refused, socket.lost);
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

// The message, or why it is none.
Result<Message> read(Parts& parts, bool from_router) {
  Message message;
  const int envelope_at = from_router ? 1 : 0;
  if (from_router) message.peer = parts.part[0].to_string();
  if (parts.count < envelope_at + 1 || parts.count > envelope_at + 2) {
    return Error(fmt::format("a message of {} parts; one or two are expected", parts.count - envelope_at));
  }
  const zmq::message_t& envelope = parts.part[envelope_at];
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

Context::Context() : transport_(std::make_unique<Transport>()) {}
Context::~Context() = default;

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
  while (publishes && receive_parts(transport_->zmq)) {
  }  // subscriptions as they come in; nothing is decided by them
  if (send_parts(transport_->zmq, {}, bytes, payload) == Sent::kYes) return {};
  if (!publishes) return Error(fmt::format("{}: not connected, or too much waits to be sent", transport_->endpoint));
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

std::optional<Message> Socket::receive() {
  const bool is_router = transport_->type == zmq::socket_type::router;
  while (auto parts = receive_parts(transport_->zmq)) {
    auto message = read(*parts, is_router);
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

Result<Socket> bind_router(Context& context, const std::string& endpoint, const Limits& limits) {
  return open(context, zmq::socket_type::router, endpoint, limits, &zmq::socket_t::bind);
}

Result<Socket> bind_publisher(Context& context, const std::string& endpoint, const Limits& limits) {
  return open(context, zmq::socket_type::xpub, endpoint, limits, &zmq::socket_t::bind);
}

Result<Socket> connect_dealer(Context& context, const std::string& endpoint, const Limits& limits) {
  return open(context, zmq::socket_type::dealer, endpoint, limits, &zmq::socket_t::connect);
}

Result<Socket> connect_subscriber(Context& context, const std::string& endpoint, const Limits& limits) {
  return open(context, zmq::socket_type::sub, endpoint, limits, &zmq::socket_t::connect);
}

}  // namespace lfd::wire
