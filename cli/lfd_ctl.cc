// lfd ctl: looks at a running cluster and changes what it shows.
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/log.h"
#include "calibration/spaces/roi.h"
#include "cli/ao_parameter.h"
#include "cli/ctl_requests.h"
#include "cli/lfd_commands.h"
#include "cli/lfd_ctl_pattern.h"
#include "cli/setting_names.h"
#include "cli/status_table.h"
#include "cli/status_watch.h"
#include "cli/watch_table.h"
#include "proto/settings.h"
#include "proto/settings_effect.h"
#include "proto/state.h"

namespace lfd {
namespace {

constexpr auto kLoadPatience = std::chrono::minutes(10);  // of a scene

// The command line of `lfd ctl`; those of its subcommands fill in what they need.
struct Arguments {
  ControllerAt controller;
  bool watch = false;
  double every_s = 1;
  std::vector<double> roi;
  std::vector<double> physical_roi;
  std::vector<double> orientation;
  bool whole = false;
  std::string scene;
  std::optional<bool> ao_enabled, ao_blur, ao_half, ao_bent, ao_open_air;
  std::optional<double> ao_radius_m, ao_sigma_px, ao_budget_ms;
  std::optional<int> ao_samples, ao_radii, ao_least_samples, ao_guard_band_px, ao_neighbours;
  std::string ao_method, ao_generator, ao_target, ao_blur_kind;
  std::vector<std::pair<std::string, double>> ao_parameters;
  std::optional<std::uint32_t> ao_seed;
  std::vector<double> ao_curve;
};

Status judge_orientation(const std::vector<double>& wxyz) {
  RegionOfInterest turned;
  turned.world_orientation = glm::dquat(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  return validate(turned);
}

Status print_status(const Arguments& arguments) {
  if (arguments.watch)
    return watch_status(arguments.controller, std::chrono::milliseconds(std::lround(arguments.every_s * 1000)));
  LFD_TRY(const proto::Status status, ask_status(arguments.controller));
  std::cout << status_table(status);
  return {};
}

Status change_roi(const Arguments& arguments) {
  const bool nothing_given =
      arguments.roi.empty() && arguments.physical_roi.empty() && arguments.orientation.empty() && !arguments.whole;
  if (nothing_given) {
    LFD_TRY(const proto::Status status, ask_status(arguments.controller));
    std::cout << roi_text(status.roi());
    return {};
  }
  proto::Request request;
  proto::RegionOfInterest& roi = *request.mutable_roi();
  if (!arguments.whole) {
    LFD_TRY(const proto::Status status, ask_status(arguments.controller));
    *roi.mutable_world_centre() = status.roi().world_centre();
    *roi.mutable_world_size() = status.roi().world_size();
    *roi.mutable_world_orientation() = status.roi().world_orientation();
  }
  if (!arguments.orientation.empty()) {
    roi.mutable_world_orientation()->set_w(arguments.orientation[0]);
    roi.mutable_world_orientation()->set_x(arguments.orientation[1]);
    roi.mutable_world_orientation()->set_y(arguments.orientation[2]);
    roi.mutable_world_orientation()->set_z(arguments.orientation[3]);
  }
  if (!arguments.roi.empty()) set_box(*roi.mutable_world_centre(), *roi.mutable_world_size(), arguments.roi);
  if (!arguments.physical_roi.empty()) {
    set_box(*roi.mutable_physical_centre(), *roi.mutable_physical_size(), arguments.physical_roi);
  }
  LFD_TRY(const proto::Reply reply, ask_controller(arguments.controller, request));
  return {};
}

// The numbers given replace those in `ao`; the others stay.
void merge_ao(const Arguments& arguments, proto::AmbientOcclusion& ao) {
  if (arguments.ao_enabled) ao.set_enabled(*arguments.ao_enabled);
  if (!arguments.ao_method.empty() && arguments.ao_method != ao.method()) {
    ao.set_method(arguments.ao_method);
    ao.clear_parameter();  // they were another method's
    ao.clear_curve();
  }
  if (arguments.ao_budget_ms) {
    ao.set_budget_ms(*arguments.ao_budget_ms);
    if (*arguments.ao_budget_ms > 0 && arguments.ao_method.empty()) {  // the nodes choose what belongs to a method
      ao.clear_method();
      ao.clear_parameter();
      ao.clear_curve();
      ao.clear_samples();
      if (ao.has_shared()) ao.mutable_shared()->set_open_air(false);  // not of every method
    }
  }
  for (const auto& [name, value] : arguments.ao_parameters) (*ao.mutable_parameter())[name] = value;
  if (arguments.ao_radius_m) ao.set_radius_m(*arguments.ao_radius_m);
  if (arguments.ao_samples) ao.set_samples(*arguments.ao_samples);
  if (arguments.ao_radii) ao.set_radii(*arguments.ao_radii);
  if (arguments.ao_least_samples) ao.set_least_samples(*arguments.ao_least_samples);
  if (arguments.ao_half) ao.set_half_resolution(*arguments.ao_half);
  if (arguments.ao_guard_band_px) ao.set_guard_band_px(*arguments.ao_guard_band_px);
  if (arguments.ao_bent) ao.set_bent_normals(*arguments.ao_bent);
  if (arguments.ao_neighbours) ao.mutable_shared()->set_neighbours(*arguments.ao_neighbours);
  if (arguments.ao_open_air) ao.mutable_shared()->set_open_air(*arguments.ao_open_air);
  if (arguments.ao_blur) ao.mutable_blur()->set_enabled(*arguments.ao_blur);
  if (arguments.ao_seed) ao.set_seed(*arguments.ao_seed);
  if (!arguments.ao_curve.empty()) {
    ao.mutable_curve()->set_a(arguments.ao_curve[0]);
    ao.mutable_curve()->set_b(arguments.ao_curve[1]);
    ao.mutable_curve()->set_c(arguments.ao_curve[2]);
  }
  if (!arguments.ao_blur_kind.empty()) ao.mutable_blur()->set_kind(kBlurNames.at(arguments.ao_blur_kind));
  if (arguments.ao_sigma_px) ao.mutable_blur()->set_sigma_px(*arguments.ao_sigma_px);
  if (!arguments.ao_generator.empty()) ao.set_generator(kGeneratorNames.at(arguments.ao_generator));
  if (!arguments.ao_target.empty()) ao.set_target(kTargetNames.at(arguments.ao_target));
}

Status change_ao(const Arguments& arguments) {
  LFD_TRY(const proto::Status status, ask_status(arguments.controller));
  proto::Request request;
  *request.mutable_ao() = status.render().ao();
  merge_ao(arguments, *request.mutable_ao());
  if (same_message(request.ao(), status.render().ao())) {  // nothing was given, or nothing else than is there
    std::cout << ao_text(status.render().ao()) << choices_text(status);
    return {};
  }
  const bool open_air_stays = arguments.ao_neighbours && !arguments.ao_open_air && request.ao().shared().open_air();
  if (open_air_stays && *arguments.ao_neighbours == 0)
    return Error("--neighbours 0: open air is on, and needs neighbours; --no-open-air switches it off");
  LFD_TRY(const proto::Reply reply, ask_controller(arguments.controller, request));
  proto::RenderSettings render = status.render();
  *render.mutable_ao() = request.ao();
  for (const std::string& line : without_effect(render)) std::cerr << "warning: " << line << "\n";
  return {};
}

Status change_scene(const Arguments& arguments) {
  std::error_code failure;
  proto::Request request;
  request.set_scene_file(std::filesystem::absolute(arguments.scene, failure).string());
  LFD_TRY(const proto::Reply reply, ask_controller(arguments.controller, request, kLoadPatience));
  LFD_TRY(const proto::Status status, ask_status(arguments.controller));
  for (const std::string& warning : status.scene_warning()) std::cerr << "warning: " << warning << "\n";
  return {};
}

Status quit(const Arguments& arguments) {
  LFD_TRY(ControlClient client, connect_controller(arguments.controller));
  return client.quit(kAnswerPatience);
}

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const occlusion::Method* method : occlusion::methods()) names.emplace_back(method->name);
  return names;
}

CLI::Validator file_name() {
  const auto wrong = [](const std::string& name) { return std::string(name.empty() ? "the name is empty" : ""); };
  return CLI::Validator(wrong, "");
}

// Every method with its parameters, a line each.
std::string method_lines() {
  std::string lines = "Methods, and what --set changes in them:\n";
  for (const occlusion::Method* method : occlusion::methods()) {
    lines += fmt::format("  {} ({})\n", method->name, method->source);
    for (const occlusion::Parameter& one : method->parameters)
      lines += fmt::format("    {:<10} {:g} to {:g}, default {:g}: {}\n", one.name, one.least, one.most, one.fallback,
                           one.meaning);
  }
  return lines;
}

// --set NAME=VALUE, as often as needed.
void add_parameters(CLI::App& command, Arguments& a) {
  const auto take = [&a](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      const auto parameter = parse_ao_parameter(text);
      if (!parameter) throw CLI::ValidationError("--set", parameter.error().message());
      a.ao_parameters.push_back(*parameter);
    }
  };
  command.add_option_function<std::vector<std::string>>("--set", take, "One of the method's parameters, see below")
      ->allow_extra_args(false)
      ->type_name("NAME=VALUE");
  command.footer(method_lines());
}

void add_ao_options(CLI::App& command, Arguments& a) {
  add_switch(command, "--on", "--off", a.ao_enabled, "Switch it on");
  command.add_option("--method", a.ao_method, "How it is computed; parameters and curve are then the method's own")
      ->check(CLI::IsMember(method_names()));
  command
      .add_option("--budget", a.ao_budget_ms,
                  "Milliseconds of GPU time for all modules of a node: without --method every node takes the most "
                  "accurate settings that it draws in this time; method, parameters, samples and "
                  "curve are forgotten (0: no budget)")
      ->check(number_within(0, 1e6));
  add_parameters(command, a);
  command.add_option("--radius", a.ao_radius_m, "Radius in the world, metres (0: a share of the region of interest)")
      ->check(number_within(0, 1e15));
  command.add_option("--samples", a.ao_samples, "Samples per radius")->check(whole_number_within(1, 256));
  command
      .add_option("--least-samples", a.ao_least_samples,
                  "Fewer samples, directions or slices far away, but so many (0: as many everywhere)")
      ->check(whole_number_within(0, 256));
  command.add_option("--radii", a.ao_radii, "How many radii (R, R/2, R/4, ...)")->check(whole_number_within(1, 8));
  command.add_option("--generator", a.ao_generator, "Of the samples")->check(CLI::IsMember(names_of(kGeneratorNames)));
  command.add_option("--target", a.ao_target, "What is darkened")->check(CLI::IsMember(names_of(kTargetNames)));
  add_switch(command, "--half", "--full", a.ao_half, "Half the resolution, brought to all pixels");
  command
      .add_option("--guard-band", a.ao_guard_band_px, "Draw so many pixels beside the images too, for their borders")
      ->check(whole_number_within(0, 1024));
  add_switch(command, "--bent-normals", "--plain-normals", a.ao_bent,
             "Light surfaces by their mean open direction, of methods that have directions");
  command.add_option("--neighbours", a.ao_neighbours, "Modules to each side whose findings are shared (0: none)")
      ->check(whole_number_within(0, 8));
  add_switch(command, "--open-air", "--no-open-air", a.ao_open_air, "What a neighbour sees in the air hides nothing");
  add_switch(command, "--blur", "--no-blur", a.ao_blur, "Blur what was sampled");
  command.add_option("--seed", a.ao_seed, "Of the samples")
      ->check(whole_number_within(0, std::numeric_limits<std::uint32_t>::max()));
  add_numbers(command, "--curve", a.ao_curve, "A,B,C", "Post curve: ao' = 1 - clamp(B ((1 - ao) + A), 0, 1)^C");
  command
      .add_option("--blur-kind", a.ao_blur_kind,
                  "By distance in the image, or by normals and depths (default: geometry where modules share and no "
                  "--sigma is given, otherwise gaussian)")
      ->check(CLI::IsMember(names_of(kBlurNames)));
  command.add_option("--sigma", a.ao_sigma_px, "Of the Gaussian blur, pixels")->check(number_within(0.1, 8));
}

}  // namespace

void add_ctl_command(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  Arguments& a = *arguments;
  CLI::App* ctl = app.add_subcommand("ctl", "Look at a running cluster, or change what it shows");
  ctl->require_subcommand(1);
  add_controller_options(*ctl, a.controller);
  const auto add = [&](const char* name, const char* description, Status (*what)(const Arguments&)) {
    CLI::App* command = add_command(*ctl, name, description, exit_code, [arguments, what] {
      const Status possible = check_ao_parameters(arguments->ao_method, arguments->ao_parameters);
      if (!possible) return wrong_use(possible.error().within("--set"));
      const Status done = what(*arguments);
      return done ? end_of_output() : fail(done.error());
    });
    command->fallthrough();  // --controller may stand behind the subcommand too
    return command;
  };
  CLI::App* status = add("status", "Print what is shown, and who takes part", print_status);
  CLI::Option* watch = status->add_flag("--watch", a.watch, "Go on printing until Ctrl-C, in a terminal in one place");
  status->add_option("--every", a.every_s, "Seconds between two tables")
      ->needs(watch)
      ->check(number_within(0.1, 3600))
      ->capture_default_str();
  CLI::App* roi = add("roi", "Change the region of interest, or print it", change_roi);
  CLI::Option* world =
      add_box(*roi, "WORLD", a.roi, Box::kWorld, "Centre and edge lengths in the world, metres (default: as it is)");
  CLI::Option* physical = add_box(*roi, "--physical", a.physical_roi, Box::kPhysical,
                                  "The same box in physical space (default: fitted to the screen)");
  CLI::Option* orientation =
      add_numbers(*roi, "--orientation", a.orientation, "W,X,Y,Z",
                  "Unit quaternion that turns the box's axes into the world's (default: as it is)", judge_orientation);
  roi->add_flag("--whole", a.whole, "Show the whole scene, unturned, fitted to the screen")
      ->excludes(world, physical, orientation);
  add_ao_options(*add("ao", "Change ambient occlusion, or print it; what is not given stays", change_ao), a);
  add("scene", "Show another scene; if it cannot be loaded the old one stays", change_scene)
      ->add_option("FILE", a.scene, "glTF file, as the controller's machine sees it")
      ->required()
      ->check(file_name());
  add_pattern_command(*ctl, {arguments, &arguments->controller}, exit_code);
  add("quit", "End the cluster", quit);
}

}  // namespace lfd
