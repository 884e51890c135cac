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
            {"occlusion_choice", node.occlusion_choice()},
            {"image_bytes", node.image_bytes()},
            {"unchanged_images", node.unchanged_images()},
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

// The node handed its last images out again.
bool is_unchanged(const proto::NodeReport& node) {
  return std::ranges::any_of(node.left_out(), [](const proto::LeftOut& left_out) {
    return left_out.what() == "module" && left_out.which() == "all";
  });
}

std::size_t modules_without_geometry(const proto::FrameReport& frame) {
  std::size_t count = 0;
  for (const proto::NodeReport& node : frame.node()) {
    count += static_cast<std::size_t>(std::ranges::count_if(node.left_out(), [](const proto::LeftOut& left_out) {
      return left_out.what() == "module" && left_out.why() == "no geometry in its view";
    }));
  }
  return count;
}

// With a budget every node chooses for itself; where two take different settings, that shows between their modules.
std::string unlike_choices(const proto::FrameReport& frame) {
  const auto settings_of = [](const proto::NodeReport& node) {
    return node.occlusion_choice().substr(0, node.occlusion_choice().find(": "));
  };
  for (const proto::NodeReport& node : frame.node()) {
    const proto::NodeReport& first = frame.node(0);
    if (settings_of(node) != settings_of(first))
      return fmt::format("nodes \"{}\" and \"{}\" chose different ambient occlusion: {}; {}", first.node(), node.node(),
                         first.occlusion_choice(), node.occlusion_choice());
  }
  return "";
}

}  // namespace

std::string report_json(const Deployment& deployment, const std::string& scene,
                        const std::vector<proto::FrameReport>& frames, const std::vector<std::string>& warnings) {
  Json json{{"version", kVersion},
            {"protocol", kProtocolVersion},
            {"deployment", deployment.message.name()},
            {"display", deployment.display.name},
            {"scene", scene},
            {"warnings", warnings},
            {"frames", Json::array()}};
  for (const proto::FrameReport& frame : frames) json["frames"].push_back(frame_json(frame));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<std::string> warnings_of(const std::vector<proto::FrameReport>& frames, std::size_t modules) {
  std::vector<std::string> warnings;
  const auto add = [&](const std::string& warning) {
    if (std::ranges::find(warnings, warning) == warnings.end()) warnings.push_back(warning);
  };
  for (const proto::FrameReport& frame : frames) {
    bool explained = false;
    for (const proto::NodeReport& node : frame.node()) {
      explained = explained || node.warning_size() > 0;
      for (const std::string& warning : node.warning()) add(warning);
    }
    if (const std::string unlike = unlike_choices(frame); !unlike.empty()) add(unlike);
    if (!explained && frame.node_size() > 0 && modules_without_geometry(frame) == modules)
      add("nothing of the scene is seen: no module has any of it in its view");
  }
  return warnings;
}

std::string time_table(const std::vector<proto::FrameReport>& frames) {
  struct Node {
    int frames = 0, drawn = 0;
    std::vector<std::pair<std::string, std::pair<double, double>>> passes;  // in their order: GPU and CPU
  };
  std::map<std::string, Node> nodes;
  for (const proto::FrameReport& frame : frames) {
    for (const proto::NodeReport& report : frame.node()) {
      Node& node = nodes[report.node()];
      ++node.frames;
      if (is_unchanged(report)) continue;
      ++node.drawn;
      for (const proto::PassTime& pass : report.pass()) {
        auto known = std::ranges::find_if(node.passes, [&](const auto& entry) { return entry.first == pass.pass(); });
        if (known == node.passes.end()) known = node.passes.insert(node.passes.end(), {pass.pass(), {0, 0}});
        known->second.first += pass.gpu_ms();
        known->second.second += pass.cpu_ms();
      }
    }
  }
  std::string table = fmt::format("{:<16} {:<20} {:>10} {:>10}\n", "node", "pass", "gpu ms", "cpu ms");
  std::string counts;
  for (const auto& [name, node] : nodes) {
    for (const auto& [pass, sums] : node.passes) {
      table += fmt::format("{:<16} {:<20} {:>10.3f} {:>10.3f}\n", name, pass, sums.first / node.drawn,
                           sums.second / node.drawn);
    }
    counts += fmt::format("{} {} of {}", counts.empty() ? "" : ",", node.drawn, node.frames);
    if (!name.empty()) counts += " by " + name;
  }
  return table + fmt::format("mean of the frames that were drawn:{}; the others repeat unchanged ones\n", counts);
}

}  // namespace lfd
