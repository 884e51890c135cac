// Deployment files, read and checked.
#include "proto/deployment_file.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <map>

#include "base/log.h"
#include "calibration/guard_band.h"
#include "proto/calibration_file.h"
#include "proto/endpoint.h"
#include "proto/module_ranges.h"
#include "proto/text_file.h"

namespace lfd {
namespace {

namespace fs = std::filesystem;

// The road to what a command line says in place of the file.
constexpr const char* kOption = "--";

// An error whose message names things for a person, with the road (proto/text_file.h) to its line beside it.
struct Fault {
  std::string road;
  Error error;
};
using Check = std::optional<Fault>;

Check check_range(const std::string& road, double value, double low, double high) {
  if (value >= low && value <= high) return std::nullopt;
  return Fault{road, Error(fmt::format("{}: {}; {} to {} are possible", road, value, low, high))};
}

Check check_node_names(const proto::Deployment& m) {
  if (m.node_size() == 0) return Fault{"", Error("node: at least one is needed")};
  std::map<std::string, int> seen;
  for (int i = 0; i < m.node_size(); ++i) {
    const std::string& name = m.node(i).name();
    const std::string road = fmt::format("node {}", i);
    if (name.empty()) return Fault{road, Error(fmt::format("{}: name: is missing", road))};
    const bool plain = std::all_of(name.begin(), name.end(), [](unsigned char c) {
      return c < 128 && (std::isalnum(c) != 0 || c == '.' || c == '-' || c == '_');
    });
    if (!plain || name.size() > 64) {
      return Fault{road + ": name",
                   Error(fmt::format("{}: name: at most 64 letters, digits, '.', '-' and '_' are possible", road))};
    }
    if (!seen.emplace(name, i).second) {
      return Fault{road + ": name",
                   Error(fmt::format("{}: name: \"{}\" is the name of node {} already", road, name, seen[name]))};
    }
    if (auto fault = check_range(road + ": gpu", m.node(i).gpu(), 0, 63)) return fault;
  }
  return std::nullopt;
}

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
    if (node.modules.empty()) {
      const std::string road = fmt::format("node {}", i);
      return Fault{road, Error(fmt::format("{}: modules: \"{}\" has none, though others have; spare nodes are not "
                                           "supported",
                                           road, node.name))};
    }
    std::sort(node.modules.begin(), node.modules.end());
  }
  return std::nullopt;
}

Check assign_modules(const proto::Deployment& m, bool use_lists, int module_count, std::vector<NodeShare>& nodes) {
  for (const auto& node : m.node()) nodes.push_back({node.name(), {}, node.has_gpu() ? node.gpu() : -1});
  const bool listed =
      std::any_of(m.node().begin(), m.node().end(), [](const auto& node) { return node.modules_size() > 0; });
  if (listed && use_lists) return assign_listed(m, module_count, nodes);
  const auto shares = equal_shares(module_count, m.node_size());
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i].modules = shares[i];
  return std::nullopt;
}

bool has_wildcard(std::string_view endpoint) {
  return endpoint.starts_with("tcp://*:") || endpoint.starts_with("tcp://0.0.0.0:") ||
         endpoint.starts_with("tcp://[::]:");
}

// Reached from this machine alone.
bool is_local(std::string_view endpoint) {
  return !endpoint.starts_with("tcp://") || endpoint.starts_with("tcp://127.") ||
         endpoint.starts_with("tcp://localhost:") || endpoint.starts_with("tcp://[::1]:");
}

Check read_addresses(const proto::Deployment::Addresses& m, Addresses& addresses) {
  std::map<std::string, std::string> seen;
  for (const auto& [field, text, address] :
       {std::tuple{"control", &m.control(), &addresses.control}, std::tuple{"state", &m.state(), &addresses.state},
        std::tuple{"bulk", &m.bulk(), &addresses.bulk}, std::tuple{"images", &m.images(), &addresses.images}}) {
    if (text->empty()) continue;
    const std::string road = fmt::format("addresses: {}", field);
    if (auto status = validate_endpoint(*text); !status) return Fault{road, status.error().within(road)};
    if (has_wildcard(*text)) {
      return Fault{road,
                   Error(fmt::format("{}: \"{}\": peers are told this address: name one interface", road, *text))};
    }
    if (is_fixed_endpoint(*text) && !seen.emplace(*text, field).second) {
      return Fault{road, Error(fmt::format("{}: \"{}\" is the address of {} already", road, *text, seen[*text]))};
    }
    *address = *text;
  }
  if (is_local(addresses.control)) return std::nullopt;
  for (const auto& [field, address] :
       {std::pair{"state", &addresses.state}, {"bulk", &addresses.bulk}, {"images", &addresses.images}}) {
    if (!is_local(*address)) continue;
    return Fault{"addresses",
                 Error(fmt::format("addresses: {}: \"{}\" cannot be reached from other machines, as control can", field,
                                   *address))};
  }
  return std::nullopt;
}

Check read_pacing(const proto::Deployment::Pacing& m, Pacing& pacing) {
  if (auto fault = check_range("pacing: frames_per_second", m.frames_per_second(), 0, 1000)) return fault;
  if (auto fault = check_range("pacing: deadline_ms", m.deadline_ms(), 0, 3'600'000)) return fault;
  if (m.heartbeat_ms() != 0) {
    if (auto fault = check_range("pacing: heartbeat_ms", m.heartbeat_ms(), 20, 60'000)) return fault;
    pacing.heartbeat = std::chrono::milliseconds(m.heartbeat_ms());
  }
  pacing.frames_per_second = m.frames_per_second();
  pacing.deadline = std::chrono::milliseconds(m.deadline_ms());
  return std::nullopt;
}

Check read_scene(const DeploymentOverrides& overrides, Deployment& deployment) {
  const auto& m = deployment.message.scene();
  if (auto fault = check_range("scene: frames_per_second", m.frames_per_second(), 0, 1000)) return fault;
  if (m.frames_per_second() > 0) deployment.animation_frames_per_second = m.frames_per_second();
  if (overrides.scene) {
    deployment.scene_file = *overrides.scene;
  } else if (!m.file().empty()) {
    deployment.scene_file = deployment.folder / m.file();
  } else if (m.made().name().empty()) {
    return Fault{"scene", Error("scene: a file or the name of a made one is needed")};
  }
  return std::nullopt;
}

Check read_display(const DeploymentOverrides& overrides, Deployment& deployment) {
  if (!overrides.display && deployment.message.display().empty()) {
    return Fault{"display", Error("display: the path of a calibration file is needed")};
  }
  deployment.display_file = overrides.display.value_or(deployment.folder / deployment.message.display());
  auto display = load_calibration(deployment.display_file);
  if (!display && overrides.display) return Fault{kOption, display.error().within("--display")};
  if (!display) return Fault{"display", display.error().within("display")};
  deployment.display = *std::move(display);
  return std::nullopt;
}

// What can be said of settings before the scene is known.
Check read_drawing(Deployment& deployment) {
  const proto::Deployment& m = deployment.message;
  auto render = read_settings(m.render());
  if (!render) {
    const Error error = render.error().within("render");
    return Fault{error.message(), error};
  }
  deployment.render = *render;
  if (const Status fits = check_guard_band(deployment.display.image, render->ao.guard_band_px); !fits) {
    const std::string road = "render: ao.guard_band_px";
    return Fault{road, fits.error().within(road)};
  }
  const int module_count = static_cast<int>(deployment.display.modules.size());
  if (const Status there = check_modules(render->pattern, module_count); !there) {
    const Error error = there.error().within("render");
    return Fault{error.message(), error};
  }
  const ScreenSize screen = deployment.display.screen;
  const auto roi = complete_roi(m.roi(), {-1, -1, -1}, {1, 1, 1}, screen.width_m, screen.height_m);
  if (!roi) return Fault{roi.error().message(), roi.error()};
  if (m.sink() < proto::Deployment::DISPLAY || m.sink() > proto::Deployment::NONE) {
    return Fault{"sink", Error("sink: must be DISPLAY, FILES or NONE")};
  }
  return std::nullopt;
}

Check read_parts(const DeploymentOverrides& overrides, Deployment& deployment) {
  if (auto fault = check_node_names(deployment.message)) return fault;
  if (auto fault = read_display(overrides, deployment)) return fault;
  if (auto fault = read_scene(overrides, deployment)) return fault;
  if (auto fault = read_drawing(deployment)) return fault;
  if (auto fault = read_addresses(deployment.message.addresses(), deployment.addresses)) return fault;
  if (auto fault = read_pacing(deployment.message.pacing(), deployment.pacing)) return fault;
  const int module_count = static_cast<int>(deployment.display.modules.size());
  if (auto fault = assign_modules(deployment.message, !overrides.display, module_count, deployment.nodes)) return fault;
  for (const NodeShare& node : deployment.nodes) {
    if (node.modules.size() <= kMaxModulesPerNode) continue;
    return Fault{"node", Error(fmt::format("node \"{}\": {} modules; a node draws at most {}", node.name,
                                           node.modules.size(), kMaxModulesPerNode))};
  }
  return std::nullopt;
}

}  // namespace

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

Result<Deployment> load_deployment(const fs::path& path, const DeploymentOverrides& overrides) {
  Deployment deployment;
  LFD_TRY(const TextPlaces places, read_text_file(path, deployment.message));
  deployment.folder = path.parent_path();
  const auto fault = read_parts(overrides, deployment);
  if (fault && fault->road == kOption) return fault->error;
  if (fault) return fault->error.within(places.of(fault->road));
  return deployment;
}

}  // namespace lfd
