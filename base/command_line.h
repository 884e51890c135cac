// Command lines of our programs: the same exit codes, and the same help to who mistyped, everywhere.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>

#include "base/result.h"

namespace lfd {

inline constexpr int kExitDone = 0, kExitFailed = 1, kExitWrongUse = 2;

// Parses; answers an exit code where the program ends here: after --help or --version (0), and after wrong use (2),
// which is explained on standard error with what was probably meant.
std::optional<int> parse_command_line(CLI::App& app, int argc, const char* const* argv);

// Prints "error: message" on standard error; kExitFailed.
int fail(const Error& error);

// The same for what a command line asks and cannot be; kExitWrongUse.
int wrong_use(const Error& error);

// A subcommand with the function that does it, called once its options are parsed; its answer goes into `exit_code`.
CLI::App* add_command(CLI::App& app, const char* name, const char* description, int& exit_code,
                      std::function<int()> run);

// --log-level, one of those that start_log() knows.
CLI::Option* add_log_level(CLI::App& app, std::string& level);

}  // namespace lfd
