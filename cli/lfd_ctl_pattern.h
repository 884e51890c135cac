// `lfd ctl pattern`, one of the subcommands of `lfd ctl`.
#pragma once

#include <memory>

#include "base/command_line.h"
#include "cli/ctl_requests.h"

namespace lfd {

// controller: as it is once the command line is parsed.
void add_pattern_command(CLI::App& ctl, std::shared_ptr<const ControllerAt> controller, int& exit_code);

}  // namespace lfd
