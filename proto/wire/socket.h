// Sockets that carry envelopes between processes, with every limit stated; the folder is the one door of ZeroMQ.
//
// Every message is [Envelope] or [Envelope, payload]. Nothing here blocks: send and receive say at once what they could
// do. A socket belongs to the thread that uses it; it may be handed to another thread once, before its first use there.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "base/result.h"
#include "proto/wire.pb.h"
#include "proto/wire/payload.h"

namespace lfd::wire {

// What one socket may hold and take. A peer that sends a larger message part is disconnected before the part is held in
// memory.
struct Limits {
  std::int64_t max_part_bytes = 0;
  int queued_messages = 0;  // per peer and direction; beyond it send() refuses
};
// Control and state: whole scenes without their assets.
inline constexpr Limits kSmallMessages{std::int64_t{64} << 20, 1000};
// Bulk: chunks of assets; at most 64 MiB wait per peer.
inline constexpr std::uint32_t kChunk_bytes = 1u << 20;
inline constexpr Limits kChunks{kChunk_bytes, 64};
// Images: the largest is RGBA32F with sides of kMaxImageSide_px; credits bound what waits.
inline constexpr Limits kImages{std::int64_t{16} * 8192 * 8192, 256};

// The transport of a process: one per process, made first and destroyed last, shared by all threads.
class Context {
 public:
  Context();
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  struct Transport;
  Transport& transport() { return *transport_; }

 private:
  std::unique_ptr<Transport> transport_;
};

struct Message {
  std::string peer;  // of a router: who sent it (opaque bytes; a peer that reconnects is another one); else empty
  proto::Envelope envelope;
  Payload payload;
};

class Socket {
 public:
  Socket(Socket&&) noexcept;
  Socket& operator=(Socket&&) noexcept;
  ~Socket();

  // The endpoint with its real port, e.g. "tcp://127.0.0.1:40123" where tcp://127.0.0.1:* was asked for.
  const std::string& endpoint() const;

  // Sends from a dealer or publisher. The protocol number is filled in where it is 0. Errors: the queue is full or, of
  // a dealer, the peer is not connected (nothing is kept for a peer that is away: send again later); the message
  // exceeds the limits. A publisher's send fails only by size: what a slow subscriber's queue cannot take is lost to
  // that subscriber alone, counted in lost() and warned of; it finds the gap by the sequence numbers.
  Status send(const proto::Envelope& envelope, const Payload& payload = {});

  // Sends from a router to one peer. Errors: no such peer (any more), its queue is full, the message exceeds the
  // limits.
  Status send_to(const std::string& peer, const proto::Envelope& envelope, const Payload& payload = {});

  // The next message, if one is there. Messages that cannot be parsed, are of another protocol version or have too many
  // parts are left out, counted in refused() and warned of (at most once in 5 s). A router answers those of another
  // version with Refused, and a Refused is received whatever its version, so that both sides know.
  std::optional<Message> receive();

  // Messages received and left out.
  std::uint64_t refused() const;
  // Messages of a publisher that at least one subscriber did not get.
  std::uint64_t lost() const;

  // How long what was sent may take to leave after the socket is destroyed; 0 unless set. For last words (Quit, Leave).
  void linger(std::chrono::milliseconds at_most);

  struct Transport;
  Transport& transport() const { return *transport_; }
  explicit Socket(std::unique_ptr<Transport> transport);

 private:
  std::unique_ptr<Transport> transport_;
};

// Endpoints: tcp://ADDRESS:PORT (port * chooses a free one) or ipc://PATH (the file is removed when the socket goes).
// A bind error names the endpoint and, where it is taken, the process that owns it:
//   tcp://127.0.0.1:5555: the address is in use by process 4711 (lfd-controller)
Result<Socket> bind_router(Context& context, const std::string& endpoint, const Limits& limits = kSmallMessages);
Result<Socket> bind_publisher(Context& context, const std::string& endpoint, const Limits& limits = kSmallMessages);

// Connections are made in the background, and made again for ever; only an endpoint that cannot be read is an error.
Result<Socket> connect_dealer(Context& context, const std::string& endpoint, const Limits& limits = kSmallMessages);
// Receives everything published once the subscription has arrived; what was published before that is lost to it.
Result<Socket> connect_subscriber(Context& context, const std::string& endpoint, const Limits& limits = kSmallMessages);

}  // namespace lfd::wire
