// Reading and writing ranges of modules.
#include "proto/module_ranges.h"

#include <charconv>
#include <numeric>
#include <optional>

#include "base/log.h"

namespace lfd {
namespace {

std::optional<int> parse_number(std::string_view text) {
  int number = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (failure != std::errc() || end != text.data() + text.size() || number < 0) return std::nullopt;
  return number;
}

}  // namespace

Result<ModuleRange> parse_range(std::string_view text) {
  const std::size_t dash = text.find('-');
  const auto first = parse_number(text.substr(0, dash));
  const auto last = dash == text.npos ? first : parse_number(text.substr(dash + 1));
  if (!first || !last) return Error(fmt::format("\"{}\" is neither a module number nor a range", text));
  if (*last < *first) return Error(fmt::format("\"{}\" runs backwards", text));
  return ModuleRange{*first, *last};
}

Status check_within_display(const ModuleRange& range, int module_count) {
  if (range.last < module_count) return {};
  return Error(fmt::format("{}; the display has modules 0 to {}", range.last, module_count - 1));
}

Result<std::vector<int>> parse_module_range(std::string_view text, int module_count) {
  LFD_TRY(const ModuleRange range, parse_range(text));
  LFD_TRY_STATUS(check_within_display(range, module_count));
  std::vector<int> modules(static_cast<std::size_t>(range.last - range.first + 1));
  std::iota(modules.begin(), modules.end(), range.first);
  return modules;
}

std::string module_ranges(std::span<const int> modules) {
  std::string text;
  for (std::size_t first = 0; first < modules.size();) {
    std::size_t last = first;
    while (last + 1 < modules.size() && modules[last + 1] == modules[last] + 1) ++last;
    if (!text.empty()) text += ",";
    text += last == first ? fmt::format("{}", modules[first]) : fmt::format("{}-{}", modules[first], modules[last]);
    first = last + 1;
  }
  return text;
}

}  // namespace lfd
