// Command lines through CLI11.
#include "base/command_line.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include "base/log.h"
#include "base/suggest.h"
#include "base/version.h"

namespace lfd {
namespace {

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

std::string meant(const std::string& written, const std::vector<std::string>& known) {
  const auto near = closest(written, known);
  return near ? fmt::format("; did you mean {}?", *near) : "";
}

// The first option or command on the line that is not known, with what it may have been meant to be; empty where all
// are.
std::string explain_unknown(const CLI::App& app, int argc, const char* const* argv) {
  const CLI::App* command = &app;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--") break;
    if (argument.starts_with("-") && argument.size() > 1) {
      const std::string name = argument.substr(0, argument.find('='));
      const CLI::Option* option = command->get_option_no_throw(name);
      for (const CLI::App* at = command; option == nullptr && at->get_fallthrough() && at->get_parent() != nullptr;)
        option = (at = at->get_parent())->get_option_no_throw(name);
      if (option != nullptr) {
        if (name == argument) i += option->get_items_expected_min();
      } else if (name.starts_with("--")) {
        return fmt::format("unknown option {}{}", name, meant(name, option_names(*command)));
      }
      continue;
    }
    const auto commands =
        command->get_subcommands([&argument](const CLI::App* one) { return one->check_name(argument); });
    if (!commands.empty()) {
      command = commands.front();
    } else if (const auto known = command_names(*command); !known.empty()) {
      return fmt::format("unknown command {}{}", argument, meant(argument, known));
    }
  }
  return "";
}

const CLI::App& deepest_parsed(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? app : deepest_parsed(*chosen.back());
}

template <class Number>
CLI::Validator within(Number low, Number high, const std::string& what) {
  const auto wrong = [low, high, what](const std::string& text) -> std::string {
    Number number = 0;
    if (CLI::detail::lexical_cast(text, number) && number >= low && number <= high) return "";
    return fmt::format("{}; {}{} to {} are possible", text, what, low, high);
  };
  return CLI::Validator(wrong, fmt::format("{} to {}", low, high));
}

}  // namespace

std::optional<int> parse_command_line(CLI::App& app, int argc, const char* const* argv) {
  try {
    app.set_version_flag("--version", std::string(kVersion), "Print the version");
    app.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
      app.exit(error);
      return kExitDone;
    }
    const std::string unknown = explain_unknown(app, argc, argv);
    std::cerr << "error: " << (unknown.empty() ? error.what() : unknown) << "\n";
    std::string road = app.get_name();
    for (const CLI::App* at = &app; at != &deepest_parsed(app);)
      road += " " + (at = at->get_subcommands().back())->get_name();
    std::cerr << "see: " << road << " --help\n";
    return kExitWrongUse;
  }
}

int fail(const Error& error) {
  std::cerr << "error: " << error.message() << "\n";
  return kExitFailed;
}

int wrong_use(const Error& error) {
  fail(error);
  return kExitWrongUse;
}

CLI::App* add_command(CLI::App& app, const char* name, const char* description, int& exit_code,
                      std::function<int()> run) {
  CLI::App* command = app.add_subcommand(name, description);
  command->callback([&exit_code, run = std::move(run)] { exit_code = run(); });
  return command;
}

int end_of_output() {
  std::cout.flush();
  const bool written = std::cout && std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  return written ? kExitDone : fail(Error("standard output: cannot be written"));
}

void add_switch(CLI::App& app, const std::string& yes, const std::string& no, std::optional<bool>& value,
                const std::string& description) {
  const CLI::Option* on = app.add_flag_callback(
      yes, [&value] { value = true; }, description);
  app.add_flag_callback(
         no, [&value] { value = false; }, "The opposite of " + yes)
      ->excludes(app.get_option(on->get_name()));
}

CLI::Option* add_list(CLI::App& app, const std::string& name, std::vector<std::string>& words,
                      const std::string& description) {
  const auto take = [&words, name](const std::vector<std::string>& lists) {
    words.clear();
    for (const std::string& list : lists) {
      for (std::string_view rest = list;;) {
        const std::size_t comma = rest.find(',');
        if (rest.substr(0, comma).empty())
          throw CLI::ValidationError(name, fmt::format("a name is empty in \"{}\"", list));
        words.emplace_back(rest.substr(0, comma));
        if (comma == rest.npos) break;
        rest.remove_prefix(comma + 1);
      }
    }
  };
  return app.add_option_function<std::vector<std::string>>(name, take, description)->allow_extra_args(false);
}

CLI::Option* add_numbers(CLI::App& app, const std::string& name, std::vector<double>& numbers, const std::string& form,
                         const std::string& description, std::function<Status(const std::vector<double>&)> judge) {
  const int count = 1 + static_cast<int>(std::ranges::count(form, ','));
  const auto take = [&numbers, name, form, count, judge = std::move(judge)](const std::vector<double>& given) {
    const bool whole = static_cast<int>(given.size()) == count;
    if (!whole) throw CLI::ValidationError(name, fmt::format("{} numbers; {} is expected", given.size(), form));
    if (!std::ranges::all_of(given, [](double number) { return std::isfinite(number); }))
      throw CLI::ValidationError(name, "every number must be finite");
    if (const Status judged = judge(given); !judged) throw CLI::ValidationError(name, judged.error().message());
    numbers = given;
  };
  return app.add_option_function<std::vector<double>>(name, take, description)
      ->delimiter(',')
      ->expected(1, count)
      ->allow_extra_args(false)
      ->type_name(form);
}

CLI::Validator number_within(double low, double high) { return within(low, high, ""); }

CLI::Validator whole_number_within(std::int64_t low, std::int64_t high) {
  return within(low, high, "whole numbers from ");
}

CLI::Validator file_ending(const std::string& ending) {
  const auto wrong = [ending](const std::string& name) -> std::string {
    return name.ends_with(ending) ? "" : fmt::format("{}: the name must end in {}", name, ending);
  };
  return CLI::Validator(wrong, "*" + ending);
}

CLI::Validator one_of(const std::string& what, std::vector<std::string> names) {
  const std::string form = fmt::format("{}", fmt::join(names, "|"));
  const auto wrong = [what, names = std::move(names)](const std::string& text) -> std::string {
    return std::ranges::find(names, text) != names.end() ? "" : unknown_text(what, text, names);
  };
  return CLI::Validator(wrong, form);
}

CLI::Validator seed_number() {
  const auto wrong = [](const std::string& text) -> std::string {
    std::uint64_t number = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (failure == std::errc() && end == text.data() + text.size()) return "";
    return fmt::format("{}; whole numbers from 0 to {} are possible", text, std::numeric_limits<std::uint64_t>::max());
  };
  return CLI::Validator(wrong, "");
}

CLI::Option* add_log_level(CLI::App& app, std::string& level) {
  return app.add_option("--log-level", level, "trace, debug, info, warn, error or off")
      ->check(CLI::IsMember({"trace", "debug", "info", "warn", "error", "off"}))
      ->capture_default_str();
}

}  // namespace lfd
