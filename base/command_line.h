// Command lines of our programs: the same exit codes, and the same help to who mistyped, everywhere.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

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

// Prints nothing more: kExitDone where all of standard output could be written, else a line on standard error and
// kExitFailed.
int end_of_output();

// A choice of two, e.g. "--on" and "--off": absent where neither is given; both together are wrong use.
void add_switch(CLI::App& app, const std::string& yes, const std::string& no, std::optional<bool>& value,
                const std::string& description);

// Words between commas in one argument, none of them empty; may be given several times.
CLI::Option* add_list(CLI::App& app, const std::string& name, std::vector<std::string>& words,
                      const std::string& description);

// As many finite numbers between commas as `form` names ("X,Y,Z"), in one argument. `judge` may refuse them.
CLI::Option* add_numbers(
    CLI::App& app, const std::string& name, std::vector<double>& numbers, const std::string& form,
    const std::string& description,
    std::function<Status(const std::vector<double>&)> judge = [](const std::vector<double>&) { return Status(); });

// A number from `low` to `high`; "nan" is none.
CLI::Validator number_within(double low, double high);

// The same for whole numbers.
CLI::Validator whole_number_within(std::int64_t low, std::int64_t high);

// The name of a file that ends so (".png").
CLI::Validator file_ending(const std::string& ending);

// One of these words; the error says what was probably meant ("unknown kind gird; did you mean grid?").
CLI::Validator one_of(const std::string& what, std::vector<std::string> names);

// A whole number that fits into 64 bits, without a sign.
CLI::Validator seed_number();

// --log-level, one of those that start_log() knows.
CLI::Option* add_log_level(CLI::App& app, std::string& level);

}  // namespace lfd
