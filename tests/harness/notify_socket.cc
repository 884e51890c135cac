// A unix datagram socket.
#include "tests/harness/notify_socket.h"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>

#include "base/check.h"

namespace lfd::harness {

NotifySocket::NotifySocket(const std::filesystem::path& folder)
    : path_(folder / "notify"), descriptor_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  LFD_CHECK(path_.string().size() < sizeof address.sun_path, "the path of a socket is short");
  std::ranges::copy(path_.string(), address.sun_path);
  LFD_CHECK(::bind(descriptor_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0, path_.string());
}

NotifySocket::~NotifySocket() { ::close(descriptor_); }

std::map<std::string, std::string> NotifySocket::environment(Clock::duration watchdog) const {
  std::map<std::string, std::string> variables{{"NOTIFY_SOCKET", path_.string()}};
  if (watchdog > Clock::duration::zero())
    variables["WATCHDOG_USEC"] =
        std::to_string(std::chrono::duration_cast<std::chrono::microseconds>(watchdog).count());
  return variables;
}

std::optional<std::string> NotifySocket::next(Clock::duration at_most) {
  pollfd ready{.fd = descriptor_, .events = POLLIN, .revents = 0};
  const auto patience = std::chrono::ceil<std::chrono::milliseconds>(std::max(at_most, Clock::duration::zero()));
  if (::poll(&ready, 1, static_cast<int>(patience.count())) <= 0) return std::nullopt;
  char bytes[4096];
  const ssize_t got = ::recv(descriptor_, bytes, sizeof bytes, 0);
  if (got < 0) return std::nullopt;
  return heard_.emplace_back(bytes, static_cast<std::size_t>(got));
}

bool NotifySocket::hears(const std::string& beginning, Clock::duration at_most) {
  const auto deadline = Clock::now() + at_most;
  while (Clock::now() < deadline) {
    const auto message = next(deadline - Clock::now());
    if (message && message->starts_with(beginning)) return true;
  }
  return false;
}

bool NotifySocket::has_heard(const std::string& beginning) const {
  return std::ranges::any_of(heard_, [&](const std::string& message) { return message.starts_with(beginning); });
}

}  // namespace lfd::harness
