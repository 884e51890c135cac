// Whether the key that a message came with opens what the message asks for.
#pragma once

#include <string>

#include "base/result.h"
#include "proto/key_files.h"
#include "proto/wire.pb.h"

namespace lfd::controller {

// `allowed`: null where the deployment works without keys; then everybody may do everything. `user`: the member that a
// message is of. Errors say which right is missing.

// A node needs the key of its own name, a display one with right DISPLAY.
Status may_join(const AllowList* allowed, const std::string& user, const proto::Join& join);

// Looking and following need right STATUS or CONTROL, everything else CONTROL.
Status may_ask(const AllowList* allowed, const std::string& user, const proto::Request& request);

}  // namespace lfd::controller
