// Deployment files, read and checked.
#include "proto/deployment_file.h"

#include "base/log.h"
#include "calibration/guard_band.h"
#include "proto/calibration_file.h"
#include "proto/deployment_checks.h"
#include "proto/text_file.h"

namespace lfd {
namespace deployment {

Check check_range(const std::string& road, double value, double low, double high) {
  if (value >= low && value <= high) return std::nullopt;
  return Fault{road, Error(fmt::format("{}: {}; {} to {} are possible", road, value, low, high))};
}

}  // namespace deployment
namespace {

namespace fs = std::filesystem;
using deployment::Check;
using deployment::check_range;
using deployment::Fault;
using deployment::kOption;

Check read_pacing(const proto::Deployment::Pacing& m, Pacing& pacing) {
  if (auto fault = check_range("pacing: frames_per_second", m.frames_per_second(), 0, 1000)) return fault;
  if (auto fault = check_range("pacing: deadline_ms", m.deadline_ms(), 0, 3'600'000)) return fault;
  if (m.heartbeat_ms() != 0) {
    if (auto fault = check_range("pacing: heartbeat_ms", m.heartbeat_ms(), 20, 60'000)) return fault;
    pacing.heartbeat = std::chrono::milliseconds(m.heartbeat_ms());
  }
  if (m.hang_s() != 0) {
    if (auto fault = check_range("pacing: hang_s", m.hang_s(), 5, 86'400)) return fault;
    pacing.hang = std::chrono::seconds(m.hang_s());
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
  const proto::Deployment& m = deployment.message;
  if (auto fault = read_scene(overrides, deployment)) return fault;
  if (auto fault = read_drawing(deployment)) return fault;
  if (auto fault = deployment::read_addresses(m, deployment.addresses)) return fault;
  if (auto fault = deployment::read_stream(m.stream())) return fault;
  if (auto fault = read_pacing(m.pacing(), deployment.pacing)) return fault;
  const int module_count = static_cast<int>(deployment.display.modules.size());
  if (auto fault = deployment::assign_modules(m, !overrides.display, module_count, deployment.nodes)) return fault;
  for (const NodeShare& node : deployment.nodes) {
    if (node.modules.size() <= kMaxModulesPerNode) continue;
    return Fault{"node", Error(fmt::format("node \"{}\": {} modules; a node draws at most {}", node.name,
                                           node.modules.size(), kMaxModulesPerNode))};
  }
  return std::nullopt;
}

}  // namespace

Result<Deployment> parse_deployment(std::string_view text, const std::string& name, const DisplayCalibration& display) {
  Deployment deployment;
  LFD_TRY(const TextPlaces places, parse_text(text, name, deployment.message));
  deployment.display = display;
  auto fault = deployment::check_node_names(deployment.message);
  if (!fault) fault = read_parts({}, deployment);
  if (fault) return fault->error.within(places.of(fault->road));
  return deployment;
}

Result<Deployment> load_deployment(const fs::path& path, const DeploymentOverrides& overrides) {
  Deployment deployment;
  LFD_TRY(const TextPlaces places, read_text_file(path, deployment.message));
  deployment.folder = path.parent_path();
  auto fault = deployment::check_node_names(deployment.message);
  if (!fault) fault = read_display(overrides, deployment);
  if (!fault) fault = read_parts(overrides, deployment);
  if (fault && fault->road == kOption) return fault->error;
  if (fault) return fault->error.within(places.of(fault->road));
  return deployment;
}

}  // namespace lfd
