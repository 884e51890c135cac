// Child processes that cannot be orphaned: started with their output captured, waited for with a deadline, stopped for
// sure.
#pragma once

#include <sys/types.h>

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "base/clock.h"
#include "base/result.h"

namespace lfd {

// How a process ended.
struct Exit {
  int code = 0;    // meaningful where signal is 0
  int signal = 0;  // the one that ended it
  bool operator==(const Exit&) const = default;
  bool succeeded() const { return code == 0 && signal == 0; }
  std::string text() const;  // "exit code 1", "signal 9 (Killed)"
};

// A running (or ended) child. It dies with the thread that started it (PR_SET_PDEATHSIG: keep that thread, in practice
// the main one, alive), with this object, and when this process is killed.
class Process {
 public:
  struct Options {
    std::string name;                  // for people
    std::vector<std::string> command;  // the program's path first; it is not looked up in PATH
    // Told every line of standard output and error, without its end, on a thread of its own. May be empty.
    std::function<void(std::string_view line)> on_line;
    std::size_t remembered_lines = 10000;            // the older ones are forgotten
    std::map<std::string, std::string> environment;  // beside that of this process
  };

  // Errors name the program and what the system said.
  static Result<std::unique_ptr<Process>> start(Options options);

  ~Process();  // kills what still runs
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  const std::string& name() const { return options_.name; }
  pid_t id() const { return id_; }
  std::vector<std::string> lines() const;

  // The next line that contains `text`, from the first that wait_for_line has not returned or skipped yet. Absent after
  // `at_most` and where the process has ended without such a line.
  std::optional<std::string> wait_for_line(std::string_view text, Clock::duration at_most);

  // Absent while it runs (after `at_most` has passed). Once it has ended, lines() has its last words.
  std::optional<Exit> wait(Clock::duration at_most);
  std::optional<Exit> poll() { return wait(Clock::duration::zero()); }

  void signal(int number);

  // SIGTERM, and SIGKILL where that did not end it within `patience`.
  Exit stop(Clock::duration patience);

  // Readable from the moment the process has ended (a pidfd); for poll().
  int ended_descriptor() const { return ended_; }

 private:
  explicit Process(Options options) : options_(std::move(options)) {}
  void pump();  // on lines_thread_: until the child has ended and everything it wrote is read
  void take_line(std::string line);

  Options options_;
  pid_t id_ = -1;
  int ended_ = -1;
  int output_ = -1;
  std::optional<Exit> exit_;

  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable arrived_;
  std::deque<std::string> lines_;
  std::size_t forgotten_ = 0;  // lines before lines_.front()
  std::size_t seen_ = 0;       // lines that wait_for_line has passed
  bool output_ended_ = false;
  std::thread lines_thread_;
};

// The folder of this process's own program.
std::filesystem::path own_folder();

}  // namespace lfd
