// Faults out of the environment.
#include "base/fault.h"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <mutex>

namespace lfd::fault {
namespace {

std::string_view variable(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? std::string_view() : std::string_view(value);
}

}  // namespace

std::vector<Plan> parse(std::string_view text) {
  std::vector<Plan> plans;
  while (!text.empty()) {
    const std::string_view item = text.substr(0, text.find(','));
    text.remove_prefix(std::min(item.size() + 1, text.size()));
    const std::size_t at = item.find('@'), colon = item.find(':');
    if (at == item.npos || colon == item.npos || colon < at) continue;
    Plan plan{item.substr(0, at), item.substr(at + 1, colon - at - 1), 0, false};
    const auto [end, failure] = std::from_chars(item.data() + colon + 1, item.data() + item.size(), plan.frame);
    if (failure == std::errc() && end == item.data() + item.size()) plans.push_back(plan);
  }
  return plans;
}

bool due(std::string_view action, std::string_view instant, std::uint64_t frame) {
  static std::vector<Plan> plans = parse(variable("LFD_FAULTS"));
  if (plans.empty()) return false;
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  for (Plan& plan : plans) {
    if (plan.done || plan.action != action || plan.instant != instant || frame < plan.frame) continue;
    plan.done = true;
    return true;
  }
  return false;
}

void at(std::string_view instant, std::uint64_t frame) {
  if (due("kill", instant, frame)) ::kill(::getpid(), SIGKILL);
  if (due("stop", instant, frame)) ::kill(::getpid(), SIGSTOP);
}

double slowdown() {
  static const double factor = [] {
    const std::string_view text = variable("LFD_SLOWDOWN");
    double value = 1;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return std::clamp(value, 1.0, 1000.0);
  }();
  return factor;
}

}  // namespace lfd::fault
