// One connection, one request.
#include "tests/harness/http.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/log.h"

namespace lfd::harness {
namespace {

constexpr timeval kPatience{.tv_sec = 20, .tv_usec = 0};

Result<std::string> converse(int descriptor, const std::string& request) {
  if (::send(descriptor, request.data(), request.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(request.size()))
    return Error("the request could not be sent");
  std::string answer;
  char bytes[4096];
  ssize_t got = 0;
  while ((got = ::recv(descriptor, bytes, sizeof bytes, 0)) > 0) answer.append(bytes, static_cast<std::size_t>(got));
  if (got < 0) return Error(std::strerror(errno));
  return answer;
}

}  // namespace

Result<std::string> http_get(const std::string& address, int port, const std::string& path) {
  const int descriptor = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  ::setsockopt(descriptor, SOL_SOCKET, SO_RCVTIMEO, &kPatience, sizeof kPatience);
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = ::htons(static_cast<std::uint16_t>(port));
  ::inet_pton(AF_INET, address.c_str(), &place.sin_addr);
  Result<std::string> answer = Error("nobody listens there");
  if (::connect(descriptor, reinterpret_cast<const sockaddr*>(&place), sizeof place) == 0)
    answer =
        converse(descriptor, fmt::format("GET {} HTTP/1.1\r\nHost: {}\r\nConnection: close\r\n\r\n", path, address));
  ::close(descriptor);
  if (!answer) return answer;
  const std::size_t body = answer->find("\r\n\r\n");
  if (!answer->starts_with("HTTP/1.1 200") || body == answer->npos) return Error(answer->substr(0, 200));
  return answer->substr(body + 4);
}

}  // namespace lfd::harness
