// Options that several subcommands of `lfd` share.
#include <algorithm>

#include "base/file.h"
#include "base/log.h"
#include "base/suggest.h"
#include "calibration/limits.h"
#include "calibration/spaces/roi.h"
#include "cli/lfd_commands.h"
#include "proto/deployment_keys.h"
#include "proto/endpoint.h"

namespace lfd {
namespace {

const std::vector<std::string>& buffer_names() {
  static const std::vector<std::string> names{"color", "position", "normal",
                                              "ao",    "depth",    "bent_normal"};  // in the order of BufferKind
  return names;
}

// The box by itself: the other one of the region of interest has the same shape.
Status judge_box(Box box, const std::vector<double>& numbers) {
  const glm::dvec3 centre(numbers[0], numbers[1], numbers[2]), size(numbers[3], numbers[4], numbers[5]);
  const bool has_shape = std::min({size.x, size.y, size.z}) > 0;
  // The shape of the other box: its axes are not so different that it would be refused in this one's place.
  const glm::dvec3 least(2 / kMostRoiRatio);
  const glm::dvec3 other = has_shape ? glm::max(size / std::max({size.x, size.y, size.z}), least) : glm::dvec3(1);
  RegionOfInterest roi;
  if (box == Box::kWorld) {
    roi = {{centre.x, centre.y, centre.z}, size, {1, 0, 0, 0}, {}, other};
  } else {
    roi = {{}, other, {1, 0, 0, 0}, {centre.x, centre.y, centre.z}, size};
  }
  return validate(roi);
}

}  // namespace

CLI::Option* add_box(CLI::App& app, const std::string& name, std::vector<double>& numbers, Box box,
                     const std::string& description) {
  return add_numbers(app, name, numbers, "CX,CY,CZ,SX,SY,SZ", description,
                     [box](const std::vector<double>& given) { return judge_box(box, given); });
}

void add_cluster_options(CLI::App& command, ClusterOptions& options) {
  command.add_option("DEPLOYMENT", options.deployment, "Deployment file (*.textproto)")->required();
  command.add_option("--scene", options.scene, "Show this glTF file instead of the deployment's scene");
  add_box(command, "--roi", options.roi, Box::kWorld,
          "Region of interest in the world: centre and edge lengths, metres; the whole scene without it");
  command
      .add_option("--plan", options.plan,
                  "\"everything\": leave nothing out; \"needed\": leave out what the scene does not need; default: the "
                  "deployment's")
      ->check(CLI::IsMember({"everything", "needed"}));
  command.add_flag("--no-ao", options.no_ao, "Without ambient occlusion");
  add_common_cluster_options(command, options);
}

void add_common_cluster_options(CLI::App& command, ClusterOptions& options) {
  command.add_option("--display", options.display, "Use this calibration file instead of the deployment's");
  command.add_flag("--accept-calibration", options.accept_calibration,
                   "Show the display even where its calibration misses the limits of `lfd-calibrate check`");
  add_list(command, "--module", options.modules, "Draw these modules alone: numbers and ranges (3,8-11)");
  add_log_level(command, options.log_level)->description("Of all processes: trace, debug, info, warn, error or off");
}

void add_controller_options(CLI::App& command, ControllerAt& controller) {
  const auto wrong = [](const std::string& text) {
    const Status valid = validate_endpoint(text);
    return valid ? std::string() : valid.error().message();
  };
  command
      .add_option("--controller", controller.endpoint,
                  "Control endpoint (default: the only cluster that `lfd run` runs here)")
      ->check(CLI::Validator(wrong, "tcp://HOST:PORT"));
  command.add_option(
      "--key", controller.key_file,
      "Key file, beside allow.textproto (default: that of the cluster that `lfd run` runs here, if it has keys)");
  command.add_flag(kAcceptPlainOption, controller.accept_plain,
                   "Talk to a controller without keys beyond this machine");
}

int do_with_cluster(const ClusterOptions& options, const std::function<Status(StopSignals& signals)>& what) {
  StopSignals signals;
  const auto deployment = load_deployment(options);
  if (!deployment) return fail(deployment.error());
  if (deployment->scene_file && options.replay.file.empty()) {
    if (const Status readable = check_readable(*deployment->scene_file); !readable)
      return fail(readable.error().within("scene"));
  }
  if (const auto wanted = wanted_modules(options, *deployment); !wanted) return wrong_use(wanted.error());
  const Status done = what(signals);
  return done ? kExitDone : fail(done.error());
}

Result<std::uint32_t> parse_buffers(const std::vector<std::string>& names) {
  std::uint32_t bits = 0;
  for (const std::string& name : names) {
    const auto known = std::ranges::find(buffer_names(), name);
    if (known == buffer_names().end()) return Error(unknown_text("buffer", name, buffer_names())).within("--buffers");
    bits |= 1u << std::distance(buffer_names().begin(), known);
  }
  return bits;
}

}  // namespace lfd
