// Carrying one fault out, from its beginning until nothing more is done to the cluster.
#pragma once

#include "bench/soak/faults.h"
#include "bench/soak/soak_cluster.h"

namespace lfd::bench {

// Errors: a signal came; a process could not be started, or did not do what was planted in it.
// How long nothing could be shown because the controller or the display was stopped or dead; zero in other faults.
Result<Clock::duration> carry_out(Fault fault, SoakCluster& cluster, FaultChoice& choice);

}  // namespace lfd::bench
