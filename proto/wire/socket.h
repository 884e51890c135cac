// Sockets that carry envelopes between processes, with every limit stated; the folder is the one door of ZeroMQ.
//
// Every message is [Envelope] or [Envelope, payload]. Nothing here blocks: send and receive say at once what they could
// do. A socket belongs to the thread that uses it; it may be handed to another thread once, before its first use there.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/result.h"
#include "proto/key_files.h"
#include "proto/wire.pb.h"
#include "proto/wire/payload.h"
#include "proto/wire/zap.h"

namespace lfd::wire {

// What one socket may hold and take. A peer that sends a larger message part is disconnected before the part is held in
// memory; an envelope that is too long is left out before it is parsed.
struct Limits {
  std::int64_t max_part_bytes = 0;       // that is received
  int queued_messages = 0;               // per peer and direction; beyond it send() refuses
  std::int64_t max_sent_part_bytes = 0;  // 0: as of what is received
  std::int64_t max_envelope_bytes = 0;   // that is received; 0: as of any part
  int queued_to_send = 0;                // 0: as of what is received
};
// What every envelope fits into that is not a scene, a report or an answer to a client; of a peer that has not been let
// in yet nothing longer is parsed.
inline constexpr std::int64_t kShort_bytes = std::int64_t{64} << 10;
// Control and state, as peers and clients take them: whole scenes without their assets.
inline constexpr Limits kSmallMessages{std::int64_t{64} << 20, 1000};
// Control as the controller takes it. The longest are reports of a node's frame, about 1 KiB a module where they are
// timed one by one; answers wait for a peer only while it does not read.
inline constexpr Limits kReports{.max_part_bytes = std::int64_t{4} << 20,
                                 .queued_messages = 1000,
                                 .max_sent_part_bytes = kSmallMessages.max_part_bytes,
                                 .queued_to_send = 100};
// State as the controller sends it; what it takes are subscriptions to everything, and the words of a handshake.
// A peer that has stopped with its connection open keeps what waits for it in memory: few seconds' worth.
inline constexpr Limits kUpdates{
    .max_part_bytes = 4096, .queued_messages = 256, .max_sent_part_bytes = kSmallMessages.max_part_bytes};
// Bulk: chunks of assets; at most 64 MiB wait per peer.
inline constexpr std::uint32_t kChunk_bytes = 1u << 20;
inline constexpr Limits kChunks{kChunk_bytes, 64};
// Bulk as the controller takes it: who wants what.
inline constexpr Limits kWants{
    .max_part_bytes = kShort_bytes, .queued_messages = 64, .max_sent_part_bytes = kChunk_bytes};
// Images: the largest is RGBA32F with sides of kMaxImageSide_px; credits bound what waits.
inline constexpr Limits kImages{
    .max_part_bytes = std::int64_t{16} * 8192 * 8192, .queued_messages = 256, .max_envelope_bytes = kShort_bytes};

// The transport of a process: one per process, made first and destroyed last, shared by all threads.
class Context {
 public:
  // Plain: whoever reaches a socket is heard.
  Context();
  // With keys: whatever is bound or connected is encrypted, and a bound socket hears members of the allow-list alone;
  // from the first moment, since what decides that comes before any socket. Aborts where the pair of keys is none:
  // open_context() finds that out.
  explicit Context(KeyRing keys);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  // Null where it is plain.
  const KeyRing* keys() const;

  struct Transport;
  Transport& transport() { return *transport_; }

 private:
  std::unique_ptr<Transport> transport_;
};

// Plain where `key_file` is empty, else with that key and the allow-list beside it. Errors name the file.
Result<std::unique_ptr<Context>> open_context(const std::string& key_file);

struct Message {
  std::string peer;  // of a router: who sent it (opaque bytes; a peer that reconnects is another one); else empty
  std::string user;  // of a bound socket with keys: the member's name in the allow-list; else empty
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

  // The next message, if one is there. False alarms are possible: nothing comes of a call that has left out many
  // messages in a row, and the next one goes on. Messages that cannot be parsed, are of another protocol version or
  // have too many parts are left out, counted in refused() and warned of (at most once in 5 s). A router answers those
  // of another version with Refused, and a Refused is received whatever its version, so that both sides know.
  // `is_known`: whether a peer may send envelopes of more than kShort_bytes; without it everybody may.
  std::optional<Message> receive(const std::function<bool(const std::string& peer)>& is_known = {});

  // Of a dealer that is not connected, why it is not, as far as the other side lets it know; else empty.
  std::string trouble();

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
Result<Socket> bind_router(Context& context, const std::string& endpoint, const Limits& limits = kSmallMessages,
                           Listener listener = Listener::kController);
Result<Socket> bind_publisher(Context& context, const std::string& endpoint, const Limits& limits = kSmallMessages);

// Connections are made in the background, and made again for ever; errors are an endpoint that cannot be read, and an
// allow-list without the listener.
Result<Socket> connect_dealer(Context& context, const std::string& endpoint, const Limits& limits = kSmallMessages,
                              Listener listener = Listener::kController);
// Receives everything published once the subscription has arrived; what was published before that is lost to it.
Result<Socket> connect_subscriber(Context& context, const std::string& endpoint, const Limits& limits = kSmallMessages);

}  // namespace lfd::wire
