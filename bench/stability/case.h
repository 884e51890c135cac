// A case of the stability suite: what is done, what must come out, and what did.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/result.h"

namespace lfd::gl {
class Context;
}

namespace lfd::bench {

struct Outcome {
  std::string got;
  double worst = 0;  // largest error, in the unit that `expected` names; 0 where an error is expected
  bool passed = false;
};

// What must come out is stated before anything runs: a bound with its reason, or the error that names the mistake.
struct StabilityCase {
  std::string group, name, expected;
  std::function<Outcome(const gl::Context&)> run;  // the context is current; many cases do not need it
};
using StabilityCases = std::vector<StabilityCase>;

// Errors as they are measured. An error that is not a number counts as infinite.
class Worst {
 public:
  void take(double error);
  double error() const { return error_; }
  std::size_t count() const { return count_; }

 private:
  double error_ = 0;
  std::size_t count_ = 0;
};

// Passes where at least `least` errors were measured and none is above `bound`. reason: unit of the errors and why the
// bound is what it is.
StabilityCase bounded(std::string group, std::string name, double bound, const std::string& reason,
                      std::function<void(Worst&)> measure, std::size_t least = 1);

// Passes where the result is an error whose message has `words` in it.
StabilityCase refused(std::string group, std::string name, const std::string& words, std::function<Status()> attempt);

// Passes where `find_fault` finds nothing: an empty string.
StabilityCase faultless(std::string group, std::string name, std::string expected,
                        std::function<std::string()> find_fault);

}  // namespace lfd::bench
