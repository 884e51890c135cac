// Shares of nodes, and what is stale without some of them.
#include "controller/assignment.h"

#include <algorithm>
#include <set>

#include "proto/module_ranges.h"

namespace lfd::controller {

Result<Assignment> assign_modules(const Deployment& deployment, const std::vector<std::string>& only) {
  std::set<int> wanted;
  for (const std::string& range : only) {
    auto modules = parse_module_range(range, static_cast<int>(deployment.display.modules.size()));
    if (!modules) return modules.error().within("module");
    wanted.insert(modules->begin(), modules->end());
  }
  Assignment assignment;
  for (const NodeShare& node : deployment.nodes) {
    std::vector<std::uint32_t>& modules = assignment[node.name];
    for (const int module : node.modules) {
      if (only.empty() || wanted.contains(module)) modules.push_back(static_cast<std::uint32_t>(module));
    }
  }
  return assignment;
}

std::vector<std::uint32_t> modules_without(const Assignment& assignment, const std::vector<std::string>& present) {
  std::vector<std::uint32_t> without;
  for (const auto& [node, modules] : assignment) {
    if (std::ranges::find(present, node) == present.end())
      without.insert(without.end(), modules.begin(), modules.end());
  }
  std::ranges::sort(without);
  return without;
}

}  // namespace lfd::controller
