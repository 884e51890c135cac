// Options that several subcommands of `lfd` share.
#include <algorithm>

#include "base/log.h"
#include "base/suggest.h"
#include "cli/lfd_commands.h"

namespace lfd {
namespace {

const std::vector<std::string>& buffer_names() {
  static const std::vector<std::string> names{"color", "position", "normal", "ao",
                                              "depth"};  // in the order of BufferKind
  return names;
}

}  // namespace

void add_cluster_options(CLI::App& command, ClusterOptions& options) {
  command.add_option("DEPLOYMENT", options.deployment, "Deployment file (*.textproto)")->required();
  command.add_option("--scene", options.scene, "Show this glTF file instead of the deployment's scene");
  command.add_option("--display", options.display, "Use this calibration file instead of the deployment's");
  add_numbers(command, "--roi", options.roi, kBoxForm,
              "Region of interest in the world: centre and edge lengths, metres; the whole scene without it");
  command
      .add_option("--plan", options.plan,
                  "\"everything\": leave nothing out; \"needed\": leave out what the scene does not need; default: the "
                  "deployment's")
      ->check(CLI::IsMember({"everything", "needed"}));
  command.add_flag("--no-ao", options.no_ao, "Without ambient occlusion");
  command.add_flag("--accept-calibration", options.accept_calibration,
                   "Show the display even where its calibration misses the limits of `lfd-calibrate check`");
  add_list(command, "--module", options.modules, "Draw these modules alone: numbers and ranges (3,8-11)");
  add_log_level(command, options.log_level)->description("Of all processes: trace, debug, info, warn, error or off");
}

int do_with_cluster(const ClusterOptions& options, const std::function<Status(StopSignals& signals)>& what) {
  StopSignals signals;
  const auto deployment = load_deployment(options);
  if (!deployment) return fail(deployment.error());
  if (const auto wanted = wanted_modules(options, *deployment); !wanted) return wrong_use(wanted.error());
  const Status done = what(signals);
  return done ? kExitDone : fail(done.error());
}

Result<std::uint32_t> parse_buffers(const std::vector<std::string>& names) {
  std::uint32_t bits = 0;
  for (const std::string& name : names) {
    const auto known = std::ranges::find(buffer_names(), name);
    if (known == buffer_names().end()) {
      const auto meant = closest(name, buffer_names());
      return Error(
          fmt::format("--buffers: unknown buffer {}{}", name, meant ? fmt::format("; did you mean {}?", *meant) : ""));
    }
    bits |= 1u << std::distance(buffer_names().begin(), known);
  }
  return bits;
}

}  // namespace lfd
