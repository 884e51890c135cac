// What `lfd ctl` asks of a controller that runs already.
#pragma once

#include <string>

#include "cli/control_client.h"

namespace lfd {

inline constexpr auto kAnswerPatience = std::chrono::seconds(5);

// endpoint: where the controller listens; empty: the only one that `lfd run` runs here.
Result<ControlClient> connect_controller(const std::string& endpoint);

// One request and its reply; a reply that tells an error is an error.
Result<proto::Reply> ask_controller(const std::string& endpoint, const proto::Request& request,
                                    Clock::duration patience = kAnswerPatience);

Result<proto::Status> ask_status(const std::string& endpoint);

}  // namespace lfd
