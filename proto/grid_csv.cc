// Lines of numbers to and from grids.
#include "proto/grid_csv.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <tuple>
#include <vector>

#include "base/log.h"

namespace lfd {
namespace {

constexpr std::string_view kHeader = "column,row,s,y";
constexpr std::size_t kMostHolesPerNode = 100;

struct Line {
  int number = 0, column = 0, row = 0;
  ScreenPoint at;
};

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

template <class Number>
bool parse_number(std::string_view field, Number& number) {
  const auto [end, failure] = std::from_chars(field.data(), field.data() + field.size(), number);
  return failure == std::errc() && end == field.data() + field.size();
}

// Exactly four fields parted by commas.
Result<std::array<std::string_view, 4>> split(std::string_view line) {
  std::array<std::string_view, 4> fields;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::size_t comma = line.find(',');
    if ((comma == line.npos) != (i + 1 == fields.size())) {
      return Error(fmt::format("four fields are needed: {}", kHeader));
    }
    fields[i] = trimmed(line.substr(0, comma));
    line.remove_prefix(comma == line.npos ? line.size() : comma + 1);
  }
  return fields;
}

Result<Line> parse_line(std::string_view text, int number) {
  LFD_TRY(const auto fields, split(text));
  Line line;
  line.number = number;
  for (const auto& [name, field, place] :
       {std::tuple{"column", fields[0], &line.column}, std::tuple{"row", fields[1], &line.row}}) {
    if (!parse_number(field, *place) || *place < 0 || *place >= kMaxGridSide) {
      return Error(fmt::format("{}: \"{}\"; a whole number from 0 to {} is needed", name, field, kMaxGridSide - 1));
    }
  }
  for (const auto& [name, field, place] :
       {std::tuple{"s", fields[2], &line.at.x}, std::tuple{"y", fields[3], &line.at.y}}) {
    if (!parse_number(field, *place) || !std::isfinite(*place)) {
      return Error(fmt::format("{}: \"{}\"; a finite number is needed (leave holes out)", name, field));
    }
  }
  return line;
}

Result<std::vector<Line>> parse_lines(std::string_view text) {
  std::vector<Line> lines;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (number == 1) {
      if (line != kHeader) return Error(fmt::format("1: the first line must be \"{}\"", kHeader));
    } else if (!line.empty()) {
      const auto parsed = parse_line(line, number);
      if (!parsed) return parsed.error().within(fmt::to_string(number));
      lines.push_back(*parsed);
    }
  }
  if (lines.empty()) return Error("no nodes");
  return lines;
}

}  // namespace

Result<GridNodes> parse_grid_csv(std::string_view text) {
  LFD_TRY(const auto lines, parse_lines(text));
  GridNodes nodes;
  for (const Line& line : lines) {
    nodes.columns = std::max(nodes.columns, line.column + 1);
    nodes.rows = std::max(nodes.rows, line.row + 1);
  }
  const auto columns = static_cast<std::size_t>(nodes.columns), count = columns * static_cast<std::size_t>(nodes.rows);
  if (lines.size() * kMostHolesPerNode < count) {
    return Error(fmt::format("{} lines for {} x {} nodes; at least one node in {} must be given", lines.size(),
                             nodes.columns, nodes.rows, kMostHolesPerNode));
  }
  constexpr double kHole = std::numeric_limits<double>::quiet_NaN();
  nodes.node.assign(count, {kHole, kHole});
  for (const Line& line : lines) {
    ScreenPoint& node =
        nodes.node[static_cast<std::size_t>(line.row) * columns + static_cast<std::size_t>(line.column)];
    if (!std::isnan(node.x)) {
      return Error(fmt::format("{}: column {}, row {} is given twice", line.number, line.column, line.row));
    }
    node = line.at;
  }
  if (const auto fault = node_fault(nodes)) {
    const auto at = std::ranges::find_if(
        lines, [&](const Line& line) { return line.column == fault->column && line.row == fault->row; });
    return Error(fmt::format("{}: {}: {}", at->number, fault->coordinate, fault->what));
  }
  return nodes;
}

std::string print_grid_csv(const GridNodes& nodes) {
  std::string text(kHeader);
  text += '\n';
  for (int row = 0; row < nodes.rows; ++row) {
    for (int column = 0; column < nodes.columns; ++column) {
      const ScreenPoint& s = nodes.at(column, row);
      if (!std::isnan(s.x)) fmt::format_to(std::back_inserter(text), "{},{},{},{}\n", column, row, s.x, s.y);
    }
  }
  return text;
}

}  // namespace lfd
