// Sets spdlog up: standard error, monotonic-enough stamps with milliseconds, the name of the process in each line.
#include "base/log.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>

namespace lfd {
namespace {

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

void write(Level level, const std::string& text) { spdlog::default_logger_raw()->log(spdlog_level(level), text); }

}  // namespace log

void start_log(std::string_view who, std::string_view level) {
  auto logger = std::make_shared<spdlog::logger>(std::string(who), std::make_shared<spdlog::sinks::stderr_sink_mt>());
  logger->set_pattern("%H:%M:%S.%e %L [%n] %v");
  logger->set_level(spdlog::level::from_str(std::string(level)));
  logger->flush_on(spdlog::level::trace);
  spdlog::set_default_logger(std::move(logger));
}

}  // namespace lfd
