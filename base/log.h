// The log of a process: one line an event, to standard error, without control characters. spdlog writes it (log.cc is its one door): its headers
// would cost every file seconds to compile.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

namespace lfd {

// Starts the log of this process. `who` stands in every line (e.g. "node left"). Level: trace, debug, info, warn,
// error, off.
void start_log(std::string_view who, std::string_view level);

namespace log {

enum class Level { kTrace, kDebug, kInfo, kWarn, kError };

bool is_on(Level level);
void write(Level level, const std::string& text);

template <class... Args>
void write_if_on(Level level, fmt::format_string<Args...> form, Args&&... args) {
  if (is_on(level)) write(level, fmt::format(form, std::forward<Args>(args)...));
}

template <class... Args>
void trace(fmt::format_string<Args...> form, Args&&... args) {
  write_if_on(Level::kTrace, form, std::forward<Args>(args)...);
}
template <class... Args>
void debug(fmt::format_string<Args...> form, Args&&... args) {
  write_if_on(Level::kDebug, form, std::forward<Args>(args)...);
}
template <class... Args>
void info(fmt::format_string<Args...> form, Args&&... args) {
  write_if_on(Level::kInfo, form, std::forward<Args>(args)...);
}
template <class... Args>
void warn(fmt::format_string<Args...> form, Args&&... args) {
  write_if_on(Level::kWarn, form, std::forward<Args>(args)...);
}
template <class... Args>
void error(fmt::format_string<Args...> form, Args&&... args) {
  write_if_on(Level::kError, form, std::forward<Args>(args)...);
}

}  // namespace log

}  // namespace lfd
