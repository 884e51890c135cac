// Child processes by fork and exec, their output by a pipe, their end by a pidfd.
#include "base/process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/log.h"

namespace lfd {
namespace {

std::string system_says() { return std::strerror(errno); }

std::vector<std::string> merged_environment(const std::map<std::string, std::string>& more) {
  std::vector<std::string> all;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    if (!more.contains(std::string(text.substr(0, text.find('='))))) all.emplace_back(text);
  }
  for (const auto& [name, value] : more) all.push_back(name + "=" + value);
  return all;
}

std::vector<char*> pointers(std::vector<std::string>& strings) {
  std::vector<char*> pointers;
  for (std::string& string : strings) pointers.push_back(string.data());
  pointers.push_back(nullptr);
  return pointers;
}

// In the child, between fork and exec: only async-signal-safe calls. Never returns.
[[noreturn]] void become(char* const* arguments, char* const* environment, int output, int failure, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(127);  // the parent died before it could be tied to us
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::setpgid(0, 0);  // Ctrl-C reaches the parent alone, which stops its children in order
  const int silence = ::open("/dev/null", O_RDONLY);
  if (silence >= 0) ::dup2(silence, STDIN_FILENO);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(output, STDERR_FILENO);
  ::execve(arguments[0], arguments, environment);
  const int reason = errno;
  [[maybe_unused]] const auto written = ::write(failure, &reason, sizeof reason);
  ::_exit(127);
}

Exit exit_of(int status) {
  if (WIFSIGNALED(status)) return {.code = 0, .signal = WTERMSIG(status)};
  return {.code = WEXITSTATUS(status), .signal = 0};
}

}  // namespace

std::string Exit::text() const {
  return signal != 0 ? fmt::format("signal {} ({})", signal, ::strsignal(signal)) : fmt::format("exit code {}", code);
}

Result<std::unique_ptr<Process>> Process::start(Options options) {
  LFD_CHECK(!options.command.empty(), "a process has a program");
  std::vector<std::string> words = options.command;
  std::vector<std::string> variables = merged_environment(options.environment);
  const std::vector<char*> arguments = pointers(words);
  const std::vector<char*> environment = pointers(variables);
  int output[2], failure[2];
  if (::pipe2(output, O_CLOEXEC) != 0) return Error(fmt::format("{}: pipe: {}", words[0], system_says()));
  if (::pipe2(failure, O_CLOEXEC) != 0) {
    ::close(output[0]);
    ::close(output[1]);
    return Error(fmt::format("{}: pipe: {}", words[0], system_says()));
  }
  const pid_t parent = ::getpid();
  const pid_t id = ::fork();
  if (id == 0) become(arguments.data(), environment.data(), output[1], failure[1], parent);
  const std::string fork_failure = id < 0 ? system_says() : "";
  ::close(output[1]);
  ::close(failure[1]);
  int reason = 0;
  const bool failed =
      id < 0 || ::read(failure[0], &reason, sizeof reason) > 0;  // exec closes the pipe: nothing to read
  ::close(failure[0]);
  if (failed) {
    ::close(output[0]);
    if (id > 0) ::waitpid(id, nullptr, 0);
    return Error(fmt::format("{}: cannot be started: {}", words[0], id < 0 ? fork_failure : std::strerror(reason)));
  }
  std::unique_ptr<Process> process(new Process(std::move(options)));
  process->id_ = id;
  process->output_ = output[0];
  process->ended_ = static_cast<int>(::syscall(SYS_pidfd_open, id, 0));
  LFD_CHECK(process->ended_ >= 0, "the kernel knows pidfd_open");
  ::fcntl(process->ended_, F_SETFD, FD_CLOEXEC);
  process->lines_thread_ = std::thread(&Process::pump, process.get());
  return process;
}

Process::~Process() {
  if (!poll()) {
    ::kill(-id_, SIGKILL);  // its process group: itself, and children of its own that it did not wait for
    wait(std::chrono::hours(1));
  }
  lines_thread_.join();
  ::close(output_);
  ::close(ended_);
}

void Process::pump() {
  std::string begun;
  char bytes[4096];
  pollfd sources[] = {{.fd = output_, .events = POLLIN, .revents = 0}, {.fd = ended_, .events = POLLIN, .revents = 0}};
  while (true) {
    if (::poll(sources, 2, -1) < 0 && errno == EINTR) continue;
    if (sources[0].revents == 0)
      break;  // the child has ended and the pipe is empty, though a grandchild may hold it open
    const ssize_t count = ::read(output_, bytes, sizeof bytes);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    begun.append(bytes, static_cast<std::size_t>(count));
    for (std::size_t end = begun.find('\n'); end != std::string::npos; end = begun.find('\n')) {
      take_line(begun.substr(0, end));
      begun.erase(0, end + 1);
    }
  }
  if (!begun.empty()) take_line(std::move(begun));
  const std::lock_guard lock(mutex_);
  output_ended_ = true;
  arrived_.notify_all();
}

void Process::take_line(std::string line) {
  if (options_.on_line) options_.on_line(line);
  const std::lock_guard lock(mutex_);
  lines_.push_back(std::move(line));
  if (lines_.size() > options_.remembered_lines) {
    lines_.pop_front();
    ++forgotten_;
  }
  arrived_.notify_all();
}

std::vector<std::string> Process::lines() const {
  const std::lock_guard lock(mutex_);
  return {lines_.begin(), lines_.end()};
}

std::optional<std::string> Process::wait_for_line(std::string_view text, Clock::duration at_most) {
  const auto deadline = Clock::now() + at_most;
  std::unique_lock lock(mutex_);
  while (true) {
    for (seen_ = std::max(seen_, forgotten_); seen_ < forgotten_ + lines_.size();) {
      const std::string& line = lines_[seen_++ - forgotten_];
      if (line.find(text) != std::string::npos) return line;
    }
    if (output_ended_ || arrived_.wait_until(lock, deadline) == std::cv_status::timeout) return std::nullopt;
  }
}

std::optional<Exit> Process::wait(Clock::duration at_most) {
  if (exit_) return exit_;
  const auto deadline = Clock::now() + at_most;
  pollfd ended{.fd = ended_, .events = POLLIN, .revents = 0};
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    const int ready = ::poll(&ended, 1, static_cast<int>(std::max<long>(left, 0)));
    if (ready > 0) break;
    if (ready == 0 && Clock::now() >= deadline) return std::nullopt;
  }
  int status = 0;
  while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) continue;
  exit_ = exit_of(status);
  // Its last words are in the pipe, and on their way; a grandchild that goes on talking is not waited for.
  constexpr auto kLastWords = std::chrono::milliseconds(500);
  std::unique_lock lock(mutex_);
  arrived_.wait_for(lock, kLastWords, [&] { return output_ended_; });
  return exit_;
}

void Process::signal(int number) {
  if (!exit_) ::syscall(SYS_pidfd_send_signal, ended_, number, nullptr, 0);
}

Exit Process::stop(Clock::duration patience) {
  signal(SIGTERM);
  if (const auto ended = wait(patience)) return *ended;
  log::warn("{}: did not stop within {} ms; it is killed", name(), static_cast<long>(milliseconds(patience)));
  signal(SIGKILL);
  return *wait(std::chrono::hours(1));
}

std::filesystem::path own_folder() { return std::filesystem::read_symlink("/proc/self/exe").parent_path(); }

}  // namespace lfd
