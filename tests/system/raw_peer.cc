// Sockets of the system, and bytes by hand.
#include "tests/system/raw_peer.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>

#include "base/log.h"

namespace lfd::harness {
namespace {

constexpr std::size_t kGreeting_bytes = 64;
constexpr char kMore = 1, kLong = 2, kCommand = 4;

std::string big_endian(std::uint64_t number, int bytes) {
  std::string text;
  for (int i = bytes - 1; i >= 0; --i) text += static_cast<char>(number >> (8 * i) & 255);
  return text;
}

std::string header(std::uint64_t size, char flags) {
  if (size < 256) return std::string(1, flags) + static_cast<char>(size);
  return static_cast<char>(flags | kLong) + big_endian(size, 8);
}

}  // namespace

std::string zmtp_greeting(std::string_view mechanism) {
  std::string greeting = "\xFF" + std::string(8, '\0') + "\x7F";
  greeting += '\3';
  greeting += '\0';
  greeting += mechanism;
  greeting.resize(kGreeting_bytes);
  return greeting;
}

RawPeer::RawPeer(const std::string& endpoint) : descriptor_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  const std::size_t colon = endpoint.rfind(':');
  unsigned port = 0;
  std::from_chars(endpoint.data() + colon + 1, endpoint.data() + endpoint.size(), port);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = ::htonl(INADDR_LOOPBACK);
  address.sin_port = ::htons(static_cast<std::uint16_t>(port));
  if (descriptor_ >= 0 && ::connect(descriptor_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0) return;
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

RawPeer::~RawPeer() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool RawPeer::send_bytes(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0) return errno == EAGAIN;
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

std::string RawPeer::receive(std::size_t bytes, Clock::duration at_most) {
  const auto until = Clock::now() + at_most;
  std::string text;
  while (text.size() < bytes && Clock::now() < until) {
    pollfd item{descriptor_, POLLIN, 0};
    if (::poll(&item, 1, 10) <= 0) continue;
    std::string part(bytes - text.size(), '\0');
    const ssize_t got = ::recv(descriptor_, part.data(), part.size(), 0);
    if (got <= 0) break;
    text.append(part, 0, static_cast<std::size_t>(got));
  }
  return text;
}

bool RawPeer::is_hung_up_on(Clock::duration at_most) {
  const auto until = Clock::now() + at_most;
  while (Clock::now() < until) {
    pollfd item{descriptor_, POLLIN, 0};
    char bytes[4096];
    if (::poll(&item, 1, 10) > 0 && ::recv(descriptor_, bytes, sizeof bytes, 0) <= 0) return true;
  }
  return false;
}

bool RawPeer::shake_hands(const std::vector<std::pair<std::string, std::string>>& properties) {
  std::string ready = "\5READY";
  for (const auto& [name, value] : properties)
    ready += static_cast<char>(name.size()) + name + big_endian(value.size(), 4) + value;
  if (!send_bytes(zmtp_greeting("NULL") + header(ready.size(), kCommand) + ready)) return false;
  constexpr auto kPatience = std::chrono::seconds(10);
  if (receive(kGreeting_bytes, kPatience).size() < kGreeting_bytes) return false;
  const std::string theirs = receive(2, kPatience);
  return theirs.size() == 2 && theirs[0] == kCommand &&
         receive(static_cast<unsigned char>(theirs[1]), kPatience).starts_with(std::string_view("\5READY", 6));
}

bool RawPeer::send_frame_header(std::uint64_t size, bool more) { return send_bytes(header(size, more ? kMore : '\0')); }

bool RawPeer::send_frame(std::string_view body, bool more) {
  return send_bytes(header(body.size(), more ? kMore : '\0') + std::string(body));
}

}  // namespace lfd::harness
