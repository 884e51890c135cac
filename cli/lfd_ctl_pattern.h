// `lfd ctl pattern`, one of the subcommands of `lfd ctl`.
#pragma once

#include <memory>
#include <string>

#include "base/command_line.h"

namespace lfd {

// controller: the endpoint once the command line is parsed; empty: the only one that runs.
void add_pattern_command(CLI::App& ctl, std::shared_ptr<const std::string> controller, int& exit_code);

}  // namespace lfd
