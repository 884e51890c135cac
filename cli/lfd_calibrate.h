// The commands of lfd-calibrate: each adds itself to the command line.
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/command_line.h"
#include "base/log.h"
#include "proto/grid_files.h"

namespace lfd {

// --grids pfm|csv: the nodes of measured maps go into files beside the one written.
inline CLI::Option* add_grids_option(CLI::App& command, std::string& grids) {
  return command
      .add_option("--grids", grids,
                  "Put the nodes of measured maps into files beside FILE: pfm (float32) or csv; inside without it")
      ->check(CLI::IsMember({"pfm", "csv"}));
}
inline std::optional<GridFileFormat> grid_format_of(const std::string& grids) {
  if (grids.empty()) return std::nullopt;
  return grids == "pfm" ? GridFileFormat::kPfm : GridFileFormat::kCsv;
}

// "24x18": columns and rows. Error: text that is not that, named by its option.
inline Result<std::pair<int, int>> columns_and_rows(std::string_view option, std::string_view text) {
  std::pair<int, int> numbers;
  const char* const end = text.data() + text.size();
  const auto [x, no_first] = std::from_chars(text.data(), end, numbers.first);
  if (no_first == std::errc() && x != end && *x == 'x') {
    const auto [rest, no_second] = std::from_chars(x + 1, end, numbers.second);
    if (no_second == std::errc() && rest == end) return numbers;
  }
  return Error(fmt::format("{} {}: two numbers are needed, as in 24x18", option, text));
}

// Writing calibrations: make, import, export.
void add_make_command(CLI::App& app, int& exit_code);
void add_import_command(CLI::App& app, int& exit_code);
void add_export_command(CLI::App& app, int& exit_code);

// Measuring one: simulate, fit.
void add_simulate_command(CLI::App& app, int& exit_code);
void add_fit_command(CLI::App& app, int& exit_code);

// Judging one: info, check.
void add_info_command(CLI::App& app, int& exit_code);
void add_check_command(CLI::App& app, int& exit_code);

// Using one, line by line from standard input: map, ray.
void add_map_command(CLI::App& app, int& exit_code);
void add_ray_command(CLI::App& app, int& exit_code);

}  // namespace lfd
