// Which modules each node draws: those of the deployment, perhaps only some of them.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/result.h"
#include "proto/deployment_file.h"

namespace lfd::controller {

// Modules by node name, ascending.
using Assignment = std::map<std::string, std::vector<std::uint32_t>>;

// `only`: empty for all; else numbers and ranges ("3", "8-11") of those that are drawn at all. Errors name the one that
// is wrong.
Result<Assignment> assign_modules(const Deployment& deployment, const std::vector<std::string>& only);

// All modules of nodes but these, ascending.
std::vector<std::uint32_t> modules_beside(const Assignment& assignment, std::vector<std::uint32_t> fresh);

}  // namespace lfd::controller
