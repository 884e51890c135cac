// Which process listens at an endpoint of this machine, as /proc tells.
#pragma once

#include <optional>
#include <string>

namespace lfd::wire {

struct Owner {
  int process = 0;
  std::string command;  // the program's name, without its folder
};

// Of a tcp://ADDRESS:PORT or ipc://PATH endpoint. Absent where nobody listens or where the owner belongs to another
// user.
std::optional<Owner> owner_of(const std::string& endpoint);

}  // namespace lfd::wire
