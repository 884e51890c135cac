// Sets spdlog up: standard error, monotonic-enough stamps with milliseconds, the name of the process in each line.
#include "base/log.h"

#include <spdlog/sinks/stdout_sinks.h>

#include <memory>

namespace lfd {

void start_log(std::string_view who, std::string_view level) {
  auto logger = std::make_shared<spdlog::logger>(std::string(who), std::make_shared<spdlog::sinks::stderr_sink_mt>());
  logger->set_pattern("%H:%M:%S.%e %L [%n] %v");
  logger->set_level(spdlog::level::from_str(std::string(level)));
  logger->flush_on(spdlog::level::trace);
  spdlog::set_default_logger(std::move(logger));
}

}  // namespace lfd
