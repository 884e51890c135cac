// Cells of CSV files.
#pragma once

#include <string>
#include <string_view>

namespace lfd::bench {

// A cell that may hold commas, quotes and line breaks, quoted as RFC 4180 says.
inline std::string csv_cell(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

}  // namespace lfd::bench
