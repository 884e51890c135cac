// Numbers of modules as people write them: "17", "20-25".
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace lfd {

struct ModuleRange {
  int first = 0, last = 0;  // first <= last
  bool contains(int module) const { return first <= module && module <= last; }
  bool operator==(const ModuleRange&) const = default;
};

// "0-15" or "17". Errors: it is neither a number nor a range, or runs backwards.
Result<ModuleRange> parse_range(std::string_view text);

// Refuses a range that goes beyond the display: "8; the display has modules 0 to 7".
Status check_within_display(const ModuleRange& range, int module_count);

// "0-15" or "17" as ascending numbers, each below `module_count`.
Result<std::vector<int>> parse_module_range(std::string_view text, int module_count);

// Ascending numbers in ranges: "0-3,7".
std::string module_ranges(std::span<const int> modules);

}  // namespace lfd
