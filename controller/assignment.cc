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

std::vector<std::uint32_t> modules_beside(const Assignment& assignment, std::vector<std::uint32_t> fresh) {
  std::ranges::sort(fresh);
  std::vector<std::uint32_t> others;
  for (const auto& [node, modules] : assignment) {
    std::ranges::copy_if(modules, std::back_inserter(others),
                         [&](std::uint32_t module) { return !std::ranges::binary_search(fresh, module); });
  }
  std::ranges::sort(others);
  return others;
}

}  // namespace lfd::controller
