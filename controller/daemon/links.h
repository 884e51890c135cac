// The controller's three sockets.
#pragma once

#include "proto/deployment_file.h"
#include "proto/wire/socket.h"

namespace lfd::controller {

struct Links {
  wire::Socket control;  // router: joins, ready, requests
  wire::Socket state;    // publisher: updates, begin, swap
  wire::Socket bulk;     // router: assets

  // Binds all three. The error names the endpoint and, where it is taken, its owner.
  static Result<Links> open(wire::Context& context, const Addresses& addresses) {
    LFD_TRY(wire::Socket control, wire::bind_router(context, addresses.control, wire::kReports));
    LFD_TRY(wire::Socket state, wire::bind_publisher(context, addresses.state, wire::kUpdates));
    LFD_TRY(wire::Socket bulk, wire::bind_router(context, addresses.bulk, wire::kWants));
    return Links{std::move(control), std::move(state), std::move(bulk)};
  }
};

}  // namespace lfd::controller
