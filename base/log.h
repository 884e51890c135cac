// The log of a process: one line an event, to standard error, through spdlog (this is its one door).
#pragma once

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <string>
#include <string_view>

namespace lfd {

// Starts the log of this process. `who` stands in every line (e.g. "node left"). Level: trace, debug, info, warn,
// error, off.
void start_log(std::string_view who, std::string_view level);

namespace log {
using spdlog::debug;
using spdlog::error;
using spdlog::info;
using spdlog::trace;
using spdlog::warn;
}  // namespace log

}  // namespace lfd
