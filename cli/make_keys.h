// Makes the keys of a deployment, and those that it lacks.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "proto/deployment_file.h"

namespace lfd {

// Names of people beside the deployment's own members.
struct KeyHolders {
  std::vector<std::string> operators;  // may change the show; none anywhere: one named "operator" is made
  std::vector<std::string> viewers;    // may look at it
};

// Writes NAME.key for the controller, the display, every node and those people into the deployment's keys folder, and
// allow.textproto with all of them; the names whose keys are new. Members that are there keep their keys, wherever
// those lie. One process at a time does so in a folder; the others wait. Errors: the deployment has no keys folder; a
// name that nobody can have (proto/member_name.h), or that two members have (no key is written then); a key file
// without a member.
Result<std::vector<std::string>> make_keys(const Deployment& deployment, const KeyHolders& people);

// Members of the list in this folder whose key files are not there, in the list's order.
Result<std::vector<std::string>> keys_elsewhere(const std::filesystem::path& folder);

}  // namespace lfd
