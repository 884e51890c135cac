// The service manager's side of sd_notify: a datagram socket of the test's own that hears what a daemon says.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/clock.h"

namespace lfd::harness {

class NotifySocket {
 public:
  // Binds a socket file in the folder.
  explicit NotifySocket(const std::filesystem::path& folder);
  ~NotifySocket();
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;

  // For the daemon; `watchdog`: how often it has to say that it lives, at least; zero: nobody watches.
  std::map<std::string, std::string> environment(Clock::duration watchdog) const;

  // The next message; absent where none comes in time. Read on: a daemon waits where nobody does.
  std::optional<std::string> next(Clock::duration at_most);

  // Reads until a message begins so; whether one came in time.
  bool hears(const std::string& beginning, Clock::duration at_most);

  // All that was read so far, in order.
  const std::vector<std::string>& heard() const { return heard_; }
  bool has_heard(const std::string& beginning) const;

 private:
  std::filesystem::path path_;
  int descriptor_;
  std::vector<std::string> heard_;
};

}  // namespace lfd::harness
