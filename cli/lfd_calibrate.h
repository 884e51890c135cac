// The commands of lfd-calibrate: each adds itself to the command line.
#pragma once

#include "base/command_line.h"

namespace lfd {

// Writing calibrations: make, import.
void add_make_command(CLI::App& app, int& exit_code);
void add_import_command(CLI::App& app, int& exit_code);

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
