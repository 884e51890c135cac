// lfd-display: the virtual display, and what can be made of the frames that it wrote.
#include <cmath>
#include <numbers>

#include "base/command_line.h"
#include "base/descriptors.h"
#include "base/file.h"
#include "base/large_blocks.h"
#include "base/log.h"
#include "display/contact_sheet.h"
#include "display/daemon.h"
#include "display/frame_folder.h"
#include "display/viewer.h"
#include "proto/calibration_file.h"
#include "proto/deployment_file.h"
#include "proto/deployment_keys.h"
#include "proto/endpoint.h"
#include "proto/key_files.h"
#include "proto/pictures/png.h"

namespace lfd::display {
namespace {

struct ViewOptions {
  std::string frame_folder, display_file, out;
  std::vector<double> eye;
  int width_px = 0, height_px = 0;
};

struct SheetOptions {
  std::string frame_folder, out;
  int tile_width_px = 240;
};

void warn_of_missing(const std::vector<std::optional<Picture8>>& pictures) {
  std::vector<std::size_t> missing;
  for (std::size_t module = 0; module < pictures.size(); ++module) {
    if (!pictures[module]) missing.push_back(module);
  }
  if (!missing.empty()) log::warn("without the pictures of modules {}, which are not there", fmt::join(missing, ", "));
}

Status view(const ViewOptions& options) {
  LFD_TRY_STATUS(check_writable(options.out));
  LFD_TRY(const DisplayCalibration display, load_calibration(options.display_file));
  LFD_TRY(const auto pictures, read_color_images(options.frame_folder, static_cast<int>(display.modules.size())));
  const int width = options.width_px > 0 ? options.width_px : display.image.width;
  const double shape = display.screen.height_m / display.screen.width_m;
  const int height =
      options.height_px > 0 ? options.height_px : std::max(1, static_cast<int>(std::lround(width * shape)));
  warn_of_missing(pictures);
  const Eye eye{options.eye[0], options.eye[1], options.eye[2]};
  if (const double away = nearest_light_rad(display, eye); away > display.angular_scattering_rad)
    log::warn(
        "no module lights this eye: the nearest is {:.1f} degrees away; a real display is dark from there, the picture "
        "shows the light of the nearest modules all the same",
        away * 180 / std::numbers::pi);
  LFD_TRY(const Picture8 picture, viewer_picture(display, pointers_to(pictures), eye, width, height));
  return write_png(options.out, picture, PngChannels::kRgb);
}

Status sheet(const SheetOptions& options) {
  LFD_TRY_STATUS(check_writable(options.out));
  LFD_TRY(const auto pictures, read_color_images(options.frame_folder));
  LFD_TRY(const Picture8 picture, contact_sheet(pointers_to(pictures), options.tile_width_px));
  return write_png(options.out, picture, PngChannels::kRgb);
}

// The options of a display that joins; what they leave open the deployment says, where there is one.
struct JoinOptions {
  std::string deployment_file, display_file;
  DaemonOptions daemon;
  bool images_given = false;
  bool accept_plain = false;
};

Status take_deployment(JoinOptions& options) {
  DeploymentOverrides overrides;
  if (!options.display_file.empty()) overrides.display = options.display_file;
  LFD_TRY(const Deployment deployment, load_deployment(options.deployment_file, overrides));
  DaemonOptions& daemon = options.daemon;
  daemon.calibration_hash = calibration_hash(deployment.display);
  daemon.image = deployment.display.image;
  for (const NodeShare& node : deployment.nodes) daemon.nodes.insert(node.name);
  if (!options.images_given) daemon.images = deployment.addresses.images;
  if (daemon.controller.empty() && is_fixed_endpoint(deployment.addresses.control))
    daemon.controller = deployment.addresses.control;
  LFD_TRY(daemon.key_file, choose_key_file(deployment, daemon.key_file, kDisplayKey));
  options.accept_plain = deployment.message.security().accept_plain_tcp_beyond_loopback();
  return {};
}

Status run(JoinOptions options) {
  raise_descriptor_limit();
  if (!options.deployment_file.empty()) LFD_TRY_STATUS(take_deployment(options));
  const DaemonOptions& daemon = options.daemon;
  if (daemon.controller.empty())
    return Error(fmt::format("{}: the control port is not given there; say --controller", options.deployment_file));
  const char* const remedy = options.deployment_file.empty() ? kOptionsRemedy : kKeysRemedy;
  for (const std::string& endpoint : {daemon.controller, daemon.images})
    LFD_TRY_STATUS(check_endpoint(endpoint, !daemon.key_file.empty(), options.accept_plain, remedy));
  LFD_TRY_STATUS(check_key_holder(daemon.key_file, proto::Allowed::DISPLAY));
  return run_daemon(daemon);
}

void add_view(CLI::App& app, ViewOptions& options) {
  auto* command = app.add_subcommand("view", "Write what a viewer sees of a frame that was written with --out");
  command->add_option("--frames-dir", options.frame_folder, "The frame's folder, e.g. out/frame-0000")->required();
  command->add_option("--display", options.display_file, "Calibration file of the display (*.textproto)")->required();
  add_numbers(*command, "--eye", options.eye, "X,Y,Z",
              "Of the eye in physical metres; z is the distance from the screen")
      ->required();
  command->add_option("--out", options.out, "PNG file to write")->required()->check(file_ending(".png"));
  command
      ->add_option("--width", options.width_px, "Pixels over the screen's width (default: those of a module's image)")
      ->check(whole_number_within(1, 8192));
  command->add_option("--height", options.height_px, "Pixels over the screen's height (default: square pixels)")
      ->check(whole_number_within(1, 8192));
}

void add_sheet(CLI::App& app, SheetOptions& options) {
  auto* command =
      app.add_subcommand("sheet", "Put all modules of a frame that was written with --out into one picture");
  command->add_option("--frames-dir", options.frame_folder, "The frame's folder, e.g. out/frame-0000")->required();
  command->add_option("--out", options.out, "PNG file to write")->required()->check(file_ending(".png"));
  command->add_option("--tile-width", options.tile_width_px, "Pixels over each module's width")
      ->check(whole_number_within(1, 8192))
      ->capture_default_str();
}

int main_of_display(int argc, char** argv) {
  CLI::App app(
      "The virtual light-field display: joins a controller, collects whole frames of module images and writes them.",
      "lfd-display");
  app.footer("Exit codes: 0 done, 1 it failed, 2 wrong use. SIGINT and SIGTERM end it within 2 s.");
  app.require_subcommand(0, 1);
  JoinOptions join;
  DaemonOptions& daemon = join.daemon;
  ViewOptions view_options;
  SheetOptions sheet_options;
  std::string out, level = "info";
  app.add_option("DEPLOYMENT", join.deployment_file,
                 "Deployment file: addresses, keys, nodes, and the calibration that the controller's must equal");
  app.add_option("--display", join.display_file, "Calibration file used instead of the deployment's");
  app.add_option("--controller", daemon.controller, "The controller's control endpoint, e.g. tcp://127.0.0.1:5555");
  auto* images = app.add_option("--images", daemon.images, "Endpoint to take images at; port * chooses a free one")
                     ->capture_default_str();
  app.add_option("--out", out, "Write every shown frame to this folder: frame-0000/module-000.color.png, ...");
  app.add_option("--key", daemon.key_file, "Key file of the display; default: display.key of the deployment's keys");
  app.add_flag(kAcceptPlainOption, join.accept_plain,
               "Without keys and deployment: whoever reaches the addresses may take part");
  app.add_option("--name", daemon.name, "Name of this display")->capture_default_str();
  app.add_option("--metrics", daemon.metrics, kMetricsHelp)->type_name("ADDRESS:PORT");
  add_log_level(app, level);
  add_view(app, view_options);
  add_sheet(app, sheet_options);
  if (const auto code = parse_command_line(app, argc, argv)) return *code;
  if (app.get_subcommands().empty() && join.deployment_file.empty() && daemon.controller.empty()) {
    return wrong_use(Error("where is the controller? Say --controller, or give a deployment file"));
  }
  start_log(daemon.name, level);
  keep_large_blocks();
  if (!out.empty()) daemon.out = out;
  join.images_given = images->count() > 0;
  const Status status = app.got_subcommand("view")    ? view(view_options)
                        : app.got_subcommand("sheet") ? sheet(sheet_options)
                                                      : run(join);
  return status ? kExitDone : fail(status.error());
}

}  // namespace
}  // namespace lfd::display

// NOLINTNEXTLINE(bugprone-exception-escape): it ends where there is no memory
int main(int argc, char** argv) { return lfd::display::main_of_display(argc, argv); }
