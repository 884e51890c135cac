// What `lfd ctl` asks of a controller that runs already.
#pragma once

#include <string>
#include <utility>

#include "cli/control_client.h"

namespace lfd {

inline constexpr auto kAnswerPatience = std::chrono::seconds(5);

// Which controller, and as whom.
struct ControllerAt {
  ControllerAt(std::string where = {}, std::string whose_key = {})  // NOLINT: implicit by design
      : endpoint(std::move(where)), key_file(std::move(whose_key)) {}

  std::string endpoint;       // empty: the only one that `lfd run` runs here
  std::string key_file;       // empty: that of the cluster that `lfd run` runs here, if it has keys
  bool accept_plain = false;  // without keys, beyond this machine
};

// With the endpoint and the key file that it comes to. Errors: no cluster, or several, run here; plain tcp beyond this
// machine that nobody accepts.
Result<ControllerAt> resolved(ControllerAt controller);

Result<ControlClient> connect_controller(const ControllerAt& controller);

// One request and its reply; a reply that tells an error is an error.
Result<proto::Reply> ask_controller(const ControllerAt& controller, const proto::Request& request,
                                    Clock::duration patience = kAnswerPatience);

Result<proto::Status> ask_status(const ControllerAt& controller);

}  // namespace lfd
