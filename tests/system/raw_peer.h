// A peer that speaks bytes over tcp: greetings, commands and frames of ZeroMQ's protocol (ZMTP 3.0), right or wrong.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/clock.h"

namespace lfd::harness {

class RawPeer {
 public:
  // Connects to a tcp://ADDRESS:PORT of this machine; is_open() says whether it could.
  explicit RawPeer(const std::string& endpoint);
  ~RawPeer();
  RawPeer(RawPeer&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  RawPeer& operator=(RawPeer&&) = delete;

  bool is_open() const { return descriptor_ >= 0; }

  // As much of it as the other side takes in at once; false where it has hung up.
  bool send_bytes(std::string_view bytes);

  // The greeting and a READY with these properties, as the mechanism NULL has it; whether the other side agreed.
  bool shake_hands(const std::vector<std::pair<std::string, std::string>>& properties);

  // One frame of a message. `size`: what its header says; by default the truth.
  bool send_frame(std::string_view body, bool more = false);
  bool send_frame_header(std::uint64_t size, bool more = false);

  // Whether the other side ends the connection within this time; what it says before is passed over.
  bool is_hung_up_on(Clock::duration at_most);

  // What has come, waiting for so much of it.
  std::string receive(std::size_t bytes, Clock::duration at_most);

 private:
  int descriptor_ = -1;
};

// The 64 bytes that a connection begins with, for this mechanism.
std::string zmtp_greeting(std::string_view mechanism);

}  // namespace lfd::harness
