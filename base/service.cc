// libsystemd, whose one door this is.
#include "base/service.h"

#include <systemd/sd-daemon.h>

#include <cstdint>
#include <cstdlib>

namespace lfd {
namespace {

void tell(const std::string& words) { ::sd_notify(0, words.c_str()); }

}  // namespace

Service::Service() : is_started_by_manager_(std::getenv("NOTIFY_SOCKET") != nullptr) {
  std::uint64_t interval_us = 0;
  if (!is_started_by_manager_ || ::sd_watchdog_enabled(0, &interval_us) <= 0) return;
  alive_pause_ = std::chrono::microseconds(interval_us / 2);
  next_alive_ = {};
}

void Service::ready() {
  if (is_ready_ || !is_started_by_manager_) return;
  is_ready_ = true;
  tell("READY=1");
}

void Service::alive(Clock::time_point now) {
  if (now < next_alive_) return;
  next_alive_ = now + alive_pause_;
  tell("WATCHDOG=1");
}

void Service::status(const std::string& text) {
  if (!is_started_by_manager_ || text == status_) return;
  status_ = text;
  tell("STATUS=" + text);
}

void Service::stopping() {
  if (is_started_by_manager_) tell("STOPPING=1");
}

}  // namespace lfd
