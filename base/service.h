// What a daemon tells the service manager that started it (systemd): it serves, it lives, it ends. Nothing, where none
// did.
#pragma once

#include <string>

#include "base/clock.h"

namespace lfd {

class Service {
 public:
  // By the environment of the process: NOTIFY_SOCKET, WATCHDOG_USEC.
  Service();

  // The daemon serves. Only the first time counts.
  void ready();

  // The loop turns: to be said in every turn; every half of the watchdog's interval it is passed on.
  void alive(Clock::time_point now);

  // When alive() is to be said at the latest; the end of time where nobody watches.
  Clock::time_point next_alive() const { return next_alive_; }

  // One line for `systemctl status`; passed on where it is another.
  void status(const std::string& text);
  bool is_told_status() const { return is_started_by_manager_; }

  void stopping();

 private:
  bool is_started_by_manager_;
  Clock::duration alive_pause_{};  // zero: nobody watches
  Clock::time_point next_alive_ = Clock::time_point::max();
  bool is_ready_ = false;
  std::string status_;
};

}  // namespace lfd
