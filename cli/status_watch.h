// lfd ctl status --watch: asks a controller again and again, and shows what it says.
#pragma once

#include <string>

#include "base/clock.h"
#include "base/result.h"

namespace lfd {

// Until a signal comes (success). endpoint: as of connect_controller(); a controller that is away is waited for.
// Errors: no cluster runs here when it starts, and the controller refuses to answer.
Status watch_status(const std::string& endpoint, Clock::duration every);

}  // namespace lfd
