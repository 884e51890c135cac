// How sockets and contexts come to be: limits, keys, addresses.
#include <google/protobuf/stubs/logging.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/check.h"
#include "base/log.h"
#include "proto/endpoint.h"
#include "proto/wire/curve.h"
#include "proto/wire/owner.h"
#include "proto/wire/transport.h"

namespace lfd::wire {
namespace {

constexpr int kReconnectAfter_ms = 100;
constexpr int kReconnectAtMost_ms = 1000;  // the pause doubles up to this
constexpr int kHandshakeAtMost_ms = 5000;
constexpr int kEncryption_bytes = 64;  // more than encryption adds to a part

void set_limits(zmq::socket_t& socket, zmq::socket_type type, const Limits& limits) {
  namespace option = zmq::sockopt;
  socket.set(option::linger, 0);
  socket.set(option::ipv6, 0);
  socket.set(option::maxmsgsize, limits.max_part_bytes + kEncryption_bytes);
  socket.set(option::sndhwm, limits.queued_to_send > 0 ? limits.queued_to_send : limits.queued_messages);
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

// Error: the allow-list does not have the listener.
Status use_keys(zmq::socket_t& socket, const Context::Transport& context, bool binds, Listener listener) {
  if (!context.keys) return {};
  LFD_CHECK(context.handler.has_value(), "without a handler, the library would let every key in");
  namespace option = zmq::sockopt;
  const KeyRing& keys = *context.keys;
  socket.set(option::curve_publickey, keys.own.public_key());
  socket.set(option::curve_secretkey, keys.own.secret_key());
  if (binds) {
    socket.set(option::curve_server, true);
    socket.set(option::zap_domain, std::string(zap_domain(listener)));
#ifdef ZMQ_ZAP_ENFORCE_DOMAIN  // not in every build of the library
    socket.set(option::zap_enforce_domain, true);
#endif
    return {};
  }
  const Right right = listener == Listener::kDisplay ? proto::Allowed::DISPLAY : proto::Allowed::CONTROLLER;
  const Allowed* other = keys.allowed.with_right(right);
  if (other == nullptr)
    return Error(fmt::format("{} has nobody with right {}", kAllowFile, proto::Allowed::Right_Name(right)));
  socket.set(option::curve_serverkey, other->public_key);
  return {};
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
                    Attach attach, Listener listener) {
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
    if (auto keyed = use_keys(made->zmq, context.transport(), binds, listener); !keyed)
      return keyed.error().within(endpoint);
    const bool has_keys = context.keys() != nullptr;
    made->names_users = has_keys && binds;
    if (made->names_users || type == zmq::socket_type::dealer)
      made->handshakes.emplace(context.transport().zmq, made->zmq,
                               Handshakes::Side{.binds = binds, .has_keys = has_keys});
    (made->zmq.*attach)(endpoint);
    made->ipc_file = ipc_file;
    made->endpoint = binds ? made->zmq.get(zmq::sockopt::last_endpoint) : endpoint;
    return Socket(std::move(made));
  } catch (const zmq::error_t& error) {
    if (error.num() == EADDRINUSE) return taken(endpoint);
    if (binds && error.num() == ENODEV)
      return Error(fmt::format(
          "{}: this machine has no such interface; a numeric IPv4 address or an interface is needed", endpoint));
    return Error(fmt::format("{}: {}", endpoint, error.what()));
  }
}

}  // namespace

// What cannot be parsed is said by receive(), now and then; Protobuf itself would say it with every message.
Context::Context() : transport_(std::make_unique<Transport>()) { google::protobuf::SetLogHandler(nullptr); }

Context::Context(KeyRing keys) : Context() {
  const Status pair = check_pair(keys.own);
  LFD_CHECK(pair, pair.error().message());
  transport_->handler.emplace(transport_->zmq, keys.allowed);
  transport_->keys = std::move(keys);
}

Context::~Context() = default;

const KeyRing* Context::keys() const { return transport_->keys ? &*transport_->keys : nullptr; }

Result<std::unique_ptr<Context>> open_context(const std::string& key_file) {
  if (key_file.empty()) return std::make_unique<Context>();
  LFD_TRY(KeyRing keys, read_key_ring(key_file));
  if (const Status pair = check_pair(keys.own); !pair) return pair.error().within(key_file);
  return std::make_unique<Context>(std::move(keys));
}

Result<Socket> bind_router(Context& context, const std::string& endpoint, const Limits& limits, Listener listener) {
  return open(context, zmq::socket_type::router, endpoint, limits, &zmq::socket_t::bind, listener);
}

Result<Socket> bind_publisher(Context& context, const std::string& endpoint, const Limits& limits) {
  return open(context, zmq::socket_type::xpub, endpoint, limits, &zmq::socket_t::bind, Listener::kController);
}

Result<Socket> connect_dealer(Context& context, const std::string& endpoint, const Limits& limits, Listener listener) {
  return open(context, zmq::socket_type::dealer, endpoint, limits, &zmq::socket_t::connect, listener);
}

Result<Socket> connect_subscriber(Context& context, const std::string& endpoint, const Limits& limits) {
  return open(context, zmq::socket_type::sub, endpoint, limits, &zmq::socket_t::connect, Listener::kController);
}

}  // namespace lfd::wire
