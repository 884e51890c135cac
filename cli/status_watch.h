// lfd ctl status --watch: asks a controller again and again, and shows what it says.
#pragma once

#include "base/clock.h"
#include "base/result.h"
#include "cli/ctl_requests.h"

namespace lfd {

// Until a signal comes (success). A controller that is away is waited for.
// Errors: no cluster runs here when it starts, and the controller refuses to answer.
Status watch_status(const ControllerAt& controller, Clock::duration every);

}  // namespace lfd
