// A cluster that runs while one fault after the other befalls it: what was shown, how soon it was whole again, and what
// the processes that lived through it all had grown by.
#pragma once

#include <functional>
#include <string>

#include "base/result.h"
#include "base/signals.h"
#include "bench/soak/soak_table.h"

namespace lfd::bench {

// Runs in a temporary folder on free ports of the loopback interface, with the programs beside this one; the table is
// judged. Whatever ends a soak that has begun, be it a process that died for good or a signal, is in its verdict.
// Errors: the processes could not be started at all.
Result<SoakTable> soak(const SoakOptions& options, StopSignals& signals,
                       const std::function<void(const std::string& line)>& progress);

}  // namespace lfd::bench
