// The endpoint and the result go through pipes.
#include "bench/stream/two_processes.h"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "base/log.h"

namespace lfd::bench {
namespace {

// Both ends; what is written at once comes at once, as long as it is short.
struct Pipe {
  std::array<int, 2> ends{-1, -1};

  bool open() { return ::pipe(ends.data()) == 0; }
  ~Pipe() {
    for (const int end : ends) {
      if (end >= 0) ::close(end);
    }
  }
  void close_for_writing() { ::close(std::exchange(ends[1], -1)); }
  void write(const std::string& text) const {
    [[maybe_unused]] const auto written = ::write(ends[1], text.data(), text.size());
  }
  std::string read() const {
    std::array<char, 1024> text{};
    const ssize_t count = ::read(ends[0], text.data(), text.size());
    return std::string(text.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  }
};

// Another process that does this and ends.
pid_t start(const std::function<void()>& what) {
  const pid_t process = ::fork();
  if (process != 0) return process;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  what();
  ::_exit(0);
}

void end(pid_t process) {
  if (process < 0) return;
  ::kill(process, SIGKILL);  // it has nothing more to do
  ::waitpid(process, nullptr, 0);
}

}  // namespace

Result<double> between_two_processes(
    const std::function<Result<double>(const std::function<void(const std::string& endpoint)>& say)>& receive,
    const std::function<void(const std::string& endpoint)>& send) {
  Pipe endpoint, result;
  if (!endpoint.open() || !result.open()) return Error(fmt::format("pipe: {}", std::strerror(errno)));
  const pid_t receiver = start([&] {
    const Result<double> measured = receive([&](const std::string& text) { endpoint.write(text); });
    result.write(measured ? fmt::format("{}", *measured) : "!" + measured.error().message());
  });
  const pid_t sender = start([&] {
    endpoint.close_for_writing();  // so that the end of the receiver is seen
    send(endpoint.read());
  });
  if (receiver < 0 || sender < 0) {
    end(receiver);
    end(sender);
    return Error("fork: no more processes");
  }
  result.close_for_writing();
  const std::string text = result.read();
  end(receiver);
  end(sender);
  if (text.empty() || text[0] == '!') return Error(text.empty() ? "the receiving process died" : text.substr(1));
  return std::strtod(text.c_str(), nullptr);
}

}  // namespace lfd::bench
