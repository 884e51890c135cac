// lfd-controller: decides what a light-field display shows, and when.
#include <cstdio>
#include <cstdlib>

#include "base/command_line.h"
#include "base/descriptors.h"
#include "base/log.h"
#include "base/signals.h"
#include "calibration/check/acceptance.h"
#include "controller/daemon/daemon.h"
#include "controller/daemon/replay_options.h"
#include "proto/deployment_keys.h"
#include "proto/key_files.h"
#include "proto/settings.h"
#include "proto/settings_effect.h"

namespace lfd::controller {
namespace {

struct Arguments {
  std::string deployment;
  std::string scene, display;
  std::vector<double> roi;
  std::string plan, sink, key;
  bool no_ao = false;
  bool accept_calibration = false;
  bool print_endpoint = false;
  std::string log_level = "info";
  std::string metrics;
  ReplayArguments replay;
  Daemon::Options options;
};

void add_options(CLI::App& app, Arguments& a) {
  app.add_option("deployment", a.deployment, "Deployment file (*.textproto)")->required();
  app.add_option("--scene", a.scene, "Show this scene file instead of the deployment's");
  app.add_option("--display", a.display,
                 "Use this calibration file instead of the deployment's (modules in equal shares)");
  add_numbers(app, "--roi", a.roi, "CX,CY,CZ,SX,SY,SZ",
              "Region of interest in the world: centre and edge lengths, metres; the whole scene without it");
  app.add_option("--plan", a.plan,
                 "\"everything\": leave nothing out; \"needed\": leave out what the scene does not need; default: the "
                 "deployment's")
      ->check(CLI::IsMember({"everything", "needed"}));
  app.add_option("--sink", a.sink, "Where finished images go: display, files or none, instead of the deployment's")
      ->check(CLI::IsMember({"display", "files", "none"}));
  app.add_flag("--no-ao", a.no_ao, "Without ambient occlusion");
  app.add_flag("--accept-calibration", a.accept_calibration,
               "Show the display even where its calibration misses the limits of `lfd-calibrate check`");
  add_list(app, "--only-modules", a.options.only_modules, "Draw these modules alone: numbers and ranges (3,8-11)");
  app.add_flag("--idle", a.options.idle, "Draw no frame until a client asks for frames");
  app.add_option("--key", a.key, "Key file of the controller; default: controller.key of the deployment's keys");
  app.add_flag("--print-endpoint", a.print_endpoint, "Print the control endpoint on standard output, once it is bound");
  app.add_option("--metrics", a.metrics, kMetricsHelp)->type_name("ADDRESS:PORT");
  add_replay_options(app, a.replay);
  add_log_level(app, a.log_level);
}

// Refuses a calibration that misses the limits, unless it is to be accepted all the same; then it warns.
Status judge_calibration(const Arguments& a, const Deployment& deployment) {
  const Status judged = accept_calibration(deployment.display);
  if (judged) return {};
  const Error refused = judged.error().within(deployment.display_file.string());
  if (a.accept_calibration || deployment.message.accept_calibration()) {
    log::warn("{}; it is shown all the same", refused.message());
    return {};
  }
  return Error(refused.message() +
               "; `lfd-calibrate check` says more, --accept-calibration shows the display all the same");
}

Result<Deployment> read_deployment(const Arguments& a) {
  DeploymentOverrides overrides;
  if (!a.display.empty()) overrides.display = a.display;
  if (!a.scene.empty()) overrides.scene = a.scene;
  LFD_TRY(Deployment deployment, load_deployment(a.deployment, overrides));
  if (!a.roi.empty()) {
    proto::RegionOfInterest& roi = *deployment.message.mutable_roi();
    roi.Clear();
    set_box(*roi.mutable_world_centre(), *roi.mutable_world_size(), a.roi);
  }
  if (a.plan == "everything") deployment.message.mutable_render()->set_planner(proto::RenderSettings::EVERYTHING);
  if (a.plan == "needed") deployment.message.mutable_render()->set_planner(proto::RenderSettings::PLAN);
  if (a.sink == "display") deployment.message.set_sink(proto::Deployment::DISPLAY);
  if (a.sink == "files") deployment.message.set_sink(proto::Deployment::FILES);
  if (a.sink == "none") deployment.message.set_sink(proto::Deployment::NONE);
  if (a.no_ao) deployment.message.mutable_render()->mutable_ao()->set_enabled(false);
  return deployment;
}

int run(Arguments arguments) {
  StopSignals signals;
  start_log("controller", arguments.log_level);
  raise_descriptor_limit();
  auto deployment = read_deployment(arguments);
  if (!deployment) return fail(deployment.error());
  if (!arguments.replay.file.empty()) {
    auto replay = open_replay(arguments.replay, deployment->display);
    if (!replay) return fail(replay.error());
    arguments.options.replay = *std::move(replay);
  }
  for (const std::string& line : without_effect(deployment->message.render())) log::warn("render: {}", line);
  arguments.options.deployment = *deployment;
  auto metrics = open_metrics("lfd-controller", arguments.metrics);
  if (!metrics) return fail(metrics.error());
  arguments.options.metrics = *std::move(metrics);
  auto key = choose_key_file(*deployment, arguments.key, kControllerKey);
  if (!key) return wrong_use(key.error());
  if (const Status own = check_key_holder(*key, proto::Allowed::CONTROLLER); !own) return fail(own.error());
  arguments.options.key_file = *std::move(key);
  auto daemon = Daemon::open(std::move(arguments.options));  // first: whether its addresses are free is said at once
  if (!daemon) return fail(daemon.error());
  if (const Status judged = judge_calibration(arguments, *deployment); !judged) return fail(judged.error());
  log::info("control {}", (*daemon)->control_endpoint());
  if (arguments.print_endpoint) {
    std::printf("lfd-controller: control %s\n", (*daemon)->control_endpoint().c_str());
    std::fflush(stdout);
  }
  const Status ended = (*daemon)->run(signals);
  const int code = ended ? kExitDone : fail(ended.error());
  const bool loading = (*daemon)->loading();
  daemon->reset();
  if (loading) std::_Exit(code);  // nothing of the loading thread may run into what main's return destroys
  return code;
}

}  // namespace
}  // namespace lfd::controller

// NOLINTNEXTLINE(bugprone-exception-escape): it ends where there is no memory
int main(int argc, char** argv) {
  CLI::App app("Loads the scene, distributes it, opens and closes frames, answers `lfd ctl`.", "lfd-controller");
  app.footer("Exit codes: 0 done, 1 it failed, 2 wrong use. SIGINT and SIGTERM end it and tell all nodes.");
  lfd::controller::Arguments arguments;
  lfd::controller::add_options(app, arguments);
  if (const auto code = lfd::parse_command_line(app, argc, argv)) return *code;
  return lfd::controller::run(std::move(arguments));
}
