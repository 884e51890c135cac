// lfd-rendernode: draws the modules that a deployment gives it.
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "base/command_line.h"
#include "base/descriptors.h"
#include "base/log.h"
#include "base/signals.h"
#include "proto/calibration_file.h"
#include "proto/deployment_file.h"
#include "proto/deployment_keys.h"
#include "rendernode/gl/context.h"
#include "rendernode/node/daemon.h"

namespace lfd::node {
namespace {

using namespace std::chrono_literals;

struct Arguments {
  std::string deployment, display;
  DaemonOptions options;
  bool list_gpus = false;
  std::string log_level = "info";
  std::string metrics;
};

void add_options(CLI::App& app, Arguments& a) {
  app.add_option("deployment", a.deployment, "Deployment file (*.textproto)");
  app.add_option("--name", a.options.name, "Name of this node in the deployment");
  app.add_option("--controller", a.options.controller, "Control endpoint of the controller; default: the deployment's");
  app.add_option("--display", a.display, "Calibration file used instead of the deployment's");
  app.add_option("--key", a.options.key_file, "Key file of this node; default: NAME.key of the deployment's keys");
  app.add_option("--gpu", a.options.gpu,
                 "Number of the GPU (--list-gpus); default: the deployment's, else the first that works");
  app.add_option("--out", a.options.out,
                 "Folder for images where the deployment's sink is FILES; default: the deployment's");
  app.add_flag("--list-gpus", a.list_gpus, "List the GPUs that EGL offers, and end");
  app.add_option("--metrics", a.metrics, kMetricsHelp)->type_name("ADDRESS:PORT");
  add_log_level(app, a.log_level);
}

int list() {
  bool any = false;
  for (const auto& gpu : gl::list_gpus()) {
    std::printf("%d  %s  %s\n", gpu.index, gpu.usable ? "usable  " : "unusable", gpu.description.c_str());
    any = any || gpu.usable;
  }
  return any ? kExitDone : fail(Error("no GPU can be used"));
}

// Fills in what the command line leaves to the deployment. Errors: it asks for what the deployment does not have.
Status complete(Arguments& a, const Deployment& deployment) {
  const auto node = std::ranges::find(deployment.nodes, a.options.name, &NodeShare::name);
  if (node == deployment.nodes.end()) {
    return Error(fmt::format("{}: it has no node \"{}\" (--name)", a.deployment, a.options.name));
  }
  if (a.options.gpu < 0) a.options.gpu = node->gpu;
  if (a.options.controller.empty()) a.options.controller = deployment.addresses.control;
  if (a.options.controller.ends_with(":*")) {
    return Error(
        fmt::format("{}: its control address has no fixed port; name the controller with --controller", a.deployment));
  }
  LFD_TRY_STATUS(check_endpoint(deployment, a.options.controller));
  LFD_TRY(a.options.key_file, choose_key_file(deployment, a.options.key_file, a.options.name));
  if (a.options.out.empty()) {
    const std::string& files = deployment.message.files();
    a.options.out = (deployment.folder / (files.empty() ? "frames" : files)).string();
  }
  a.options.calibration_hash = calibration_hash(deployment.display);
  return {};
}

int run(Arguments a) {
  StopSignals signals;
  start_log("node " + a.options.name, a.log_level);
  raise_descriptor_limit();
  DeploymentOverrides overrides;
  if (!a.display.empty()) overrides.display = a.display;
  const auto deployment = load_deployment(a.deployment, overrides);
  if (!deployment) return fail(deployment.error());
  if (const Status completed = complete(a, *deployment); !completed) return wrong_use(completed.error());
  if (const Status own = check_key_holder(a.options.key_file, proto::Allowed::NODE, a.options.name); !own)
    return fail(own.error());
  if (const Status known = gl::check_gpu(a.options.gpu); !known) return fail(known.error());
  auto metrics = open_metrics("lfd-rendernode", a.metrics);
  if (!metrics) return fail(metrics.error());
  a.options.metrics = *std::move(metrics);
  auto daemon = Daemon::open(std::move(a.options));
  if (!daemon) return fail(daemon.error());
  const Status ended = (*daemon)->run(signals);
  const int code = ended ? kExitDone : fail(ended.error());
  // A driver call cannot be interrupted; a frame that takes longer than this is given up with the process.
  const bool drawn = (*daemon)->stop_drawing_within(200ms);
  if (!drawn) {
    std::fflush(nullptr);
    std::_Exit(code);
  }
  return code;
}

}  // namespace
}  // namespace lfd::node

// NOLINTNEXTLINE(bugprone-exception-escape): it ends where there is no memory
int main(int argc, char** argv) {
  CLI::App app("Draws the modules that a deployment gives to the node, and streams their images.", "lfd-rendernode");
  app.footer(
      "Exit codes: 0 done, 1 it failed, 2 wrong use. SIGINT and SIGTERM end it within 2 s, even while it draws.");
  lfd::node::Arguments arguments;
  lfd::node::add_options(app, arguments);
  if (const auto code = lfd::parse_command_line(app, argc, argv)) return *code;
  if (arguments.list_gpus) return lfd::node::list();
  if (arguments.deployment.empty() || arguments.options.name.empty()) {
    return lfd::wrong_use(lfd::Error("a deployment file and --name are needed (or --list-gpus)"));
  }
  return lfd::node::run(std::move(arguments));
}
