// Which node draws which modules, as a deployment file says it.
#include <algorithm>
#include <cstdint>
#include <map>

#include "base/log.h"
#include "proto/deployment_checks.h"
#include "proto/key_files.h"
#include "proto/member_name.h"
#include "proto/module_ranges.h"

namespace lfd {
namespace deployment {

Check check_node_names(const proto::Deployment& m) {
  if (m.node_size() == 0) return Fault{"", Error("node: at least one is needed")};
  std::map<std::string, int> seen;
  for (int i = 0; i < m.node_size(); ++i) {
    const std::string& name = m.node(i).name();
    const std::string road = fmt::format("node {}", i);
    if (name.empty()) return Fault{road, Error(fmt::format("{}: name: is missing", road))};
    if (const Status fits = check_member_name(name); !fits)
      return Fault{road + ": name", fits.error().within(road + ": name")};
    // Its key would be that of somebody else.
    if (name == kControllerKey || name == kDisplayKey)
      return Fault{road + ": name",
                   Error(fmt::format("{}: name: \"{}\" is the {}'s own; another is needed", road, name, name))};
    if (!seen.emplace(name, i).second) {
      return Fault{road + ": name",
                   Error(fmt::format("{}: name: \"{}\" is the name of node {} already", road, name, seen[name]))};
    }
    if (auto fault = check_range(road + ": gpu", m.node(i).gpu(), 0, 63)) return fault;
    if (m.node(i).spare() && m.node(i).modules_size() > 0)
      return Fault{road + ": modules 0", Error(fmt::format("{}: modules: \"{}\" is a spare; it takes over those of "
                                                           "another node",
                                                           road, name))};
  }
  const bool all_spare = std::ranges::all_of(m.node(), [](const auto& node) { return node.spare(); });
  if (all_spare) return Fault{"node 0: spare", Error("node: every one is a spare; at least one has to draw")};
  if (m.give_back() < proto::Deployment::WHEN_READY || m.give_back() > proto::Deployment::NEVER)
    return Fault{"give_back", Error("give_back: must be WHEN_READY or NEVER")};
  return std::nullopt;
}

namespace {

// The lists of the file; each module belongs to one node at most.
Check assign_listed(const proto::Deployment& m, int module_count, std::vector<NodeShare>& nodes) {
  std::map<int, std::string> owner;
  for (int i = 0; i < m.node_size(); ++i) {
    NodeShare& node = nodes[static_cast<std::size_t>(i)];
    for (int j = 0; j < m.node(i).modules_size(); ++j) {
      const std::string road = fmt::format("node {}: modules {}", i, j);
      const auto fault = [&](const Error& error) {
        return Fault{road, error.within(fmt::format("node \"{}\": modules", node.name))};
      };
      const auto modules = parse_module_range(m.node(i).modules(j), module_count);
      if (!modules) return fault(modules.error());
      for (const int module : *modules) {
        const auto [known, is_new] = owner.emplace(module, node.name);
        if (!is_new) return fault(Error(fmt::format("{} is owned by node \"{}\" already", module, known->second)));
        node.modules.push_back(module);
      }
    }
    if (node.modules.empty() && !node.spare) {
      const std::string road = fmt::format("node {}", i);
      return Fault{road,
                   Error(fmt::format("{}: modules: \"{}\" has none, though others have; say `spare: true` where it "
                                     "is one",
                                     road, node.name))};
    }
    std::sort(node.modules.begin(), node.modules.end());
  }
  return std::nullopt;
}

}  // namespace

Check assign_modules(const proto::Deployment& m, bool use_lists, int module_count, std::vector<NodeShare>& nodes) {
  for (const auto& node : m.node()) {
    nodes.push_back(
        {.name = node.name(), .modules = {}, .gpu = node.has_gpu() ? node.gpu() : -1, .spare = node.spare()});
  }
  const bool listed =
      std::any_of(m.node().begin(), m.node().end(), [](const auto& node) { return node.modules_size() > 0; });
  if (listed && use_lists) return assign_listed(m, module_count, nodes);
  const auto drawing = std::ranges::count(nodes, false, &NodeShare::spare);
  auto shares = equal_shares(module_count, static_cast<int>(drawing));
  std::size_t next = 0;
  for (NodeShare& node : nodes) {
    if (!node.spare) node.modules = std::move(shares[next++]);
  }
  return std::nullopt;
}

}  // namespace deployment

std::vector<int> unowned_modules(const Deployment& deployment) {
  std::vector<bool> owned(deployment.display.modules.size());
  for (const NodeShare& node : deployment.nodes) {
    for (const int module : node.modules) owned[static_cast<std::size_t>(module)] = true;
  }
  std::vector<int> unowned;
  for (std::size_t module = 0; module < owned.size(); ++module) {
    if (!owned[module]) unowned.push_back(static_cast<int>(module));
  }
  return unowned;
}

std::vector<std::vector<int>> equal_shares(int module_count, int nodes) {
  LFD_CHECK(module_count >= 0 && nodes > 0, "shares need someone to take them");
  std::vector<std::vector<int>> shares(static_cast<std::size_t>(nodes));
  for (int module = 0; module < module_count; ++module) {
    const int node = static_cast<int>(std::int64_t{module} * nodes / module_count);
    shares[static_cast<std::size_t>(node)].push_back(module);
  }
  return shares;
}

}  // namespace lfd
