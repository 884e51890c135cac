// Sets spdlog up: standard error, monotonic-enough stamps with milliseconds, the name of the process in each line.
#include "base/log.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>

#include "base/printable.h"

namespace lfd {
namespace {

constexpr std::size_t kMostLetters = 16384;  // of one event: a shader compiler may have much to say

spdlog::level::level_enum spdlog_level(log::Level level) {
  switch (level) {
    case log::Level::kTrace:
      return spdlog::level::trace;
    case log::Level::kDebug:
      return spdlog::level::debug;
    case log::Level::kInfo:
      return spdlog::level::info;
    case log::Level::kWarn:
      return spdlog::level::warn;
    case log::Level::kError:
      break;
  }
  return spdlog::level::err;
}

}  // namespace

namespace log {

bool is_on(Level level) { return spdlog::default_logger_raw()->should_log(spdlog_level(level)); }

void write(Level level, const std::string& text) {
  std::string_view shown = text;
  const bool too_long = shown.size() > kMostLetters;
  if (too_long) shown = shown.substr(0, kMostLetters);
  spdlog::default_logger_raw()->log(spdlog_level(level), printable_lines(shown) + (too_long ? " ..." : ""));
}

}  // namespace log

void start_log(std::string_view who, std::string_view level) {
  auto logger = std::make_shared<spdlog::logger>(std::string(who), std::make_shared<spdlog::sinks::stderr_sink_mt>());
  logger->set_pattern("%H:%M:%S.%e %L [%n] %v");
  logger->set_level(spdlog::level::from_str(std::string(level)));
  logger->flush_on(spdlog::level::trace);
  spdlog::set_default_logger(std::move(logger));
}

}  // namespace lfd
