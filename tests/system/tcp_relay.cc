// One thread that polls all ends.
#include "tests/system/tcp_relay.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <fstream>

#include "base/check.h"
#include "base/log.h"

namespace lfd::harness {
namespace {

sockaddr_in loopback(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

// Passes on what is there; false where an end is closed.
bool pass_on(int from, int to) {
  std::array<char, 65536> buffer;
  const ssize_t count = ::read(from, buffer.data(), buffer.size());
  if (count <= 0) return false;
  for (ssize_t at = 0; at < count;) {
    const ssize_t written = ::send(to, buffer.data() + at, static_cast<std::size_t>(count - at), MSG_NOSIGNAL);
    if (written <= 0) return false;
    at += written;
  }
  return true;
}

}  // namespace

TcpRelay::TcpRelay(const std::string& target)
    : target_port_(std::stoi(target.substr(target.rfind(':') + 1))),
      listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in address = loopback(0);
  socklen_t size = sizeof(address);
  auto* const generic = reinterpret_cast<sockaddr*>(&address);
  LFD_CHECK(::bind(listener_, generic, size) == 0 && ::listen(listener_, 16) == 0 &&
                ::getsockname(listener_, generic, &size) == 0,
            "a port of the loopback interface");
  port_ = ntohs(address.sin_port);
  thread_ = std::thread([this] { run(); });
}

TcpRelay::~TcpRelay() {
  ends_ = true;
  bell_.ring();
  thread_.join();
  ::close(listener_);
}

std::string TcpRelay::endpoint() const { return fmt::format("tcp://127.0.0.1:{}", port_); }

void TcpRelay::cut() {
  cuts_now_ = true;
  bell_.ring();
}

void TcpRelay::run() {
  while (!ends_) {
    std::vector<pollfd> ends{{bell_.descriptor(), POLLIN, 0}, {listener_, POLLIN, 0}};
    for (const auto& [left, right] : links_) {
      ends.push_back({left, POLLIN, 0});
      ends.push_back({right, POLLIN, 0});
    }
    ::poll(ends.data(), ends.size(), 1000);
    if (ends[0].revents != 0) bell_.silence();
    if (cuts_now_.exchange(false)) {
      end_all();
      continue;
    }
    std::vector<std::pair<int, int>> open;
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const auto [left, right] = links_[i];
      const bool goes_on = (ends[2 + 2 * i].revents == 0 || pass_on(left, right)) &&
                           (ends[3 + 2 * i].revents == 0 || pass_on(right, left));
      if (goes_on) {
        open.push_back(links_[i]);
      } else {
        ::close(left);
        ::close(right);
      }
    }
    links_ = std::move(open);
    if (ends[1].revents != 0) accept_one();
  }
  end_all();
}

void TcpRelay::accept_one() {
  const int left = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
  if (left < 0) return;
  const int right = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const sockaddr_in address = loopback(target_port_);
  if (::connect(right, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0) {
    links_.emplace_back(left, right);
    return;
  }
  ::close(left);
  ::close(right);
}

void TcpRelay::end_all() {
  for (const auto& [left, right] : links_) {
    ::close(left);
    ::close(right);
    ++cuts_;
  }
  links_.clear();
}

std::size_t resident_bytes(int process) {
  std::ifstream file(fmt::format("/proc/{}/statm", process));
  std::size_t pages = 0, resident = 0;
  file >> pages >> resident;
  return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

}  // namespace lfd::harness
