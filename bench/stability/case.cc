// The kinds of cases.
#include "bench/stability/case.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/log.h"

namespace lfd::bench {

void Worst::take(double error) {
  ++count_;
  error_ = std::max(error_, std::isfinite(error) ? std::abs(error) : std::numeric_limits<double>::infinity());
}

StabilityCase bounded(std::string group, std::string name, double bound, const std::string& reason,
                      std::function<void(Worst&)> measure, std::size_t least) {
  const std::string counted = least > 1 ? fmt::format("; {} at least", least) : "";
  return {std::move(group), std::move(name), fmt::format("at most {:.3g} {}{}", bound, reason, counted),
          [bound, least, measure = std::move(measure)](const gl::Context&) {
            Worst worst;
            measure(worst);
            return Outcome{fmt::format("{:.2g} at worst of {}", worst.error(), worst.count()), worst.error(),
                           worst.count() >= least && worst.error() <= bound};
          }};
}

StabilityCase refused(std::string group, std::string name, const std::string& words, std::function<Status()> attempt) {
  return {std::move(group), std::move(name), fmt::format("error: \"{}\"", words),
          [words, attempt = std::move(attempt)](const gl::Context&) {
            const Status status = attempt();
            if (status) return Outcome{"no error", 0, false};
            const std::string& message = status.error().message();
            return Outcome{"error: " + message, 0, message.find(words) != std::string::npos};
          }};
}

StabilityCase faultless(std::string group, std::string name, std::string expected,
                        std::function<std::string()> find_fault) {
  return {std::move(group), std::move(name), std::move(expected),
          [find_fault = std::move(find_fault)](const gl::Context&) {
            const std::string fault = find_fault();
            return Outcome{fault.empty() ? "as expected" : fault, 0, fault.empty()};
          }};
}

}  // namespace lfd::bench
