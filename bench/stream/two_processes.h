// A measurement between two processes, both of them forks of this one.
#pragma once

#include <functional>
#include <string>

#include "base/result.h"

namespace lfd::bench {

// `receive` runs in one: it says where it listens by calling its argument, and returns what it measured. `send` runs in
// the other, is told where that is, and ends with it. Call it while the process has no threads and little memory.
Result<double> between_two_processes(
    const std::function<Result<double>(const std::function<void(const std::string& endpoint)>& say)>& receive,
    const std::function<void(const std::string& endpoint)>& send);

}  // namespace lfd::bench
