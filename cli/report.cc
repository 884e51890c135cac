// Frame reports to JSON and to a table.
#include "cli/report.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/log.h"
#include "base/version.h"

namespace lfd {
namespace {

using Json = nlohmann::ordered_json;

Json pass_json(const proto::PassTime& pass) {
  Json json{{"pass", pass.pass()}, {"gpu_ms", pass.gpu_ms()}, {"cpu_ms", pass.cpu_ms()}};
  if (pass.module_size() > 0) json["modules"] = std::vector<std::uint32_t>(pass.module().begin(), pass.module().end());
  return json;
}

Json node_json(const proto::NodeReport& node) {
  Json json{{"node", node.node()},
            {"version", node.version()},
            {"renderer", node.renderer()},
            {"state_hash", node.state_hash()},
            {"triangles", node.triangles()},
            {"passes", Json::array()},
            {"left_out", Json::array()},
            {"warnings", std::vector<std::string>(node.warning().begin(), node.warning().end())}};
  for (const proto::PassTime& pass : node.pass()) json["passes"].push_back(pass_json(pass));
  for (const proto::LeftOut& left_out : node.left_out()) {
    json["left_out"].push_back(
        {{"what", left_out.what()}, {"which", left_out.which()}, {"why", left_out.why()}, {"count", left_out.count()}});
  }
  return json;
}

Json frame_json(const proto::FrameReport& frame) {
  const proto::Vector& origin = frame.position_origin();
  Json json{{"frame", frame.frame()},
            {"physical_from_world",
             std::vector<double>(frame.physical_from_world().begin(), frame.physical_from_world().end())},
            {"position_origin", {origin.x(), origin.y(), origin.z()}},
            {"roi_diagonal", frame.roi_diagonal()},
            {"state_hash", frame.state_hash()},
            {"begin_to_swap_ms", frame.begin_to_swap_ms()},
            {"begin_to_shown_ms", frame.begin_to_shown_ms()},
            {"stale_modules", std::vector<std::uint32_t>(frame.stale_module().begin(), frame.stale_module().end())},
            {"nodes", Json::array()}};
  for (const proto::NodeReport& node : frame.node()) json["nodes"].push_back(node_json(node));
  return json;
}

}  // namespace

std::string report_json(const Deployment& deployment, const std::string& scene,
                        const std::vector<proto::FrameReport>& frames) {
  Json json{{"version", kVersion},
            {"protocol", kProtocolVersion},
            {"deployment", deployment.message.name()},
            {"display", deployment.display.name},
            {"scene", scene},
            {"frames", Json::array()}};
  for (const proto::FrameReport& frame : frames) json["frames"].push_back(frame_json(frame));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string time_table(const std::vector<proto::FrameReport>& frames) {
  std::map<std::string, std::vector<std::pair<std::string, std::pair<double, double>>>> nodes;  // passes in their order
  for (const proto::FrameReport& frame : frames) {
    for (const proto::NodeReport& node : frame.node()) {
      auto& passes = nodes[node.node()];
      for (const proto::PassTime& pass : node.pass()) {
        auto known = std::ranges::find_if(passes, [&](const auto& entry) { return entry.first == pass.pass(); });
        if (known == passes.end()) known = passes.insert(passes.end(), {pass.pass(), {0, 0}});
        known->second.first += pass.gpu_ms();
        known->second.second += pass.cpu_ms();
      }
    }
  }
  std::string table = fmt::format("{:<16} {:<20} {:>10} {:>10}\n", "node", "pass", "gpu ms", "cpu ms");
  const double count = frames.empty() ? 1 : static_cast<double>(frames.size());
  for (const auto& [node, passes] : nodes) {
    for (const auto& [pass, sums] : passes) {
      table += fmt::format("{:<16} {:<20} {:>10.3f} {:>10.3f}\n", node, pass, sums.first / count, sums.second / count);
    }
  }
  return table;
}

}  // namespace lfd
