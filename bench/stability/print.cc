// The table for people and for spreadsheets.
#include "base/log.h"
#include "bench/common/csv.h"
#include "bench/stability/suite.h"

namespace lfd::bench {
namespace {

// A cell of a Markdown table.
std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : c == '\n' ? std::string(" ") : std::string(1, c);
  return out;
}

}  // namespace

std::string text_of(const StabilityTable& table) {
  std::string text = fmt::format("lfd {}, {}\n", table.version, table.renderer);
  std::string group;
  for (const StabilityRow& row : table.rows) {
    if (row.group != group) {
      group = row.group;
      text += fmt::format("\n## {}\n\n| case | expected | got | worst error | |\n|---|---|---|---|---|\n", group);
    }
    text += fmt::format("| {} | {} | {} | {:.2g} | {} |\n", cell(row.name), cell(row.expected), cell(row.outcome.got),
                        row.outcome.worst, row.outcome.passed ? "ok" : "MISSED");
  }
  return text + "\n" + verdict_of(table) + "\n";
}

std::string verdict_of(const StabilityTable& table) {
  const std::vector<std::string> missed = table.missed();
  if (missed.empty()) return fmt::format("all {} cases came out as stated", table.rows.size());
  std::string names;
  for (const std::string& name : missed) names += (names.empty() ? "" : "; ") + name;
  return fmt::format("{} of {} cases missed: {}", missed.size(), table.rows.size(), names);
}

std::string csv_of(const StabilityTable& table) {
  std::string csv = "group,case,expected,got,worst_error,passed,renderer,version\n";
  for (const StabilityRow& row : table.rows) {
    csv += fmt::format("{},{},{},{},{:.6e},{},{},{}\n", csv_cell(row.group), csv_cell(row.name), csv_cell(row.expected),
                       csv_cell(row.outcome.got), row.outcome.worst, row.outcome.passed, csv_cell(table.renderer),
                       csv_cell(table.version));
  }
  return csv;
}

}  // namespace lfd::bench
