// lfd ctl pattern: shows test patterns instead of the scene, and the scene again.
#include "cli/lfd_ctl_pattern.h"

#include <algorithm>
#include <iostream>
#include <optional>
#include <vector>

#include "base/log.h"
#include "cli/ctl_requests.h"
#include "cli/setting_names.h"
#include "cli/status_table.h"
#include "proto/pattern.h"

namespace lfd {
namespace {

constexpr const char* kFooter =
    "Kinds:\n"
    "  number   Every module's own number, and a frame of its outermost pixels. The frame's top left corner is "
    "filled:\n"
    "           where it is elsewhere, or the number cannot be read, a picture is flipped or turned.\n"
    "  grid     Lines a pixel wide, those through the middle red, and a frame. In space \"image\" they are counted "
    "from\n"
    "           every image's top left pixel, and the frame is its outermost pixels. In space \"screen\" they are "
    "counted\n"
    "           from the middle of the glass, through the modules' calibrated maps, and the frame is its border: "
    "where\n"
    "           the calibration is true the lines of all modules coincide.\n"
    "  checker  Squares of the pattern's colour and of black; spaces as of grid.\n"
    "  solid    The whole image in one colour.\n"
    "  off      The scene again, as it was.\n"
    "Modules are fed the colours as they are given: their colour calibrations are left out.\n"
    "Nodes that join later show the pattern too.";

struct Arguments {
  std::string kind;  // empty: it is printed
  std::string space;
  std::vector<std::string> modules;
  std::optional<int> spacing_px;
  std::optional<double> spacing_m;
  std::vector<double> color;
};

proto::TestPattern message_of(const Arguments& a) {
  proto::TestPattern pattern;
  if (!a.kind.empty()) pattern.set_kind(kPatternNames.at(a.kind));
  if (!a.space.empty()) pattern.set_space(kSpaceNames.at(a.space));
  if (a.spacing_px) pattern.set_spacing_px(*a.spacing_px);
  if (a.spacing_m) pattern.set_spacing_m(*a.spacing_m);
  if (!a.color.empty()) {
    pattern.mutable_color()->set_r(a.color[0]);
    pattern.mutable_color()->set_g(a.color[1]);
    pattern.mutable_color()->set_b(a.color[2]);
  }
  pattern.mutable_modules()->Add(a.modules.begin(), a.modules.end());
  return pattern;
}

// The exit code. What the options ask and cannot be is wrong use, modules that the display does not have too.
int change_pattern(const ControllerAt& controller, const Arguments& arguments) {
  proto::Request request;
  *request.mutable_pattern() = message_of(arguments);
  const auto pattern = read_pattern(request.pattern());
  if (!pattern) return wrong_use(pattern.error());
  const auto status = ask_status(controller);
  if (!status) return fail(status.error());
  if (arguments.kind.empty()) {
    std::cout << "pattern    " << pattern_text(status->render().pattern()) << "\n";
    return end_of_output();
  }
  if (const Status there = check_modules(*pattern, static_cast<int>(status->module_count())); !there)
    return wrong_use(there.error());
  const auto reply = ask_controller(controller, request);
  return reply ? end_of_output() : fail(reply.error());
}

Status judge_color(const std::vector<double>& color) {
  const bool fits = std::ranges::all_of(color, [](double part) { return part >= 0 && part <= 1; });
  return fits ? Status() : Error("0 to 1 are possible");
}

void add_options(CLI::App& command, Arguments& a) {
  CLI::Option* kind = command.add_option("KIND", a.kind, "What is shown, see below (default: print it)")
                          ->check(one_of("kind", names_of(kPatternNames)));
  add_list(command, "--module", a.modules,
           "Only these modules show it, the others are black: numbers and ranges (17,20-25)")
      ->needs(kind);
  command
      .add_option(
          "--space", a.space,
          "Where lines and squares are straight and at equal distances: in every image (default), or on the screen")
      ->check(CLI::IsMember(names_of(kSpaceNames)))
      ->needs(kind);
  command
      .add_option("--spacing-px", a.spacing_px,
                  "Pixels from line to line, or a square's side, in space image (default: 32)")
      ->check(whole_number_within(1, 8192))
      ->needs(kind);
  command
      .add_option("--spacing-m", a.spacing_m,
                  "Metres from line to line, or a square's side, in space screen (default: a tenth of its height)")
      ->check(number_within(1e-6, 1e4))
      ->needs(kind);
  add_numbers(command, "--color", a.color, "R,G,B",
              "As modules are fed it: 0 to 1 for the bytes 0 to 255 (default: white)", judge_color)
      ->needs(kind);
  command.footer(kFooter);
}

}  // namespace

void add_pattern_command(CLI::App& ctl, std::shared_ptr<const ControllerAt> controller, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      add_command(ctl, "pattern", "Show test patterns instead of the scene, or print which", exit_code,
                  [controller = std::move(controller), arguments] { return change_pattern(*controller, *arguments); });
  command->fallthrough();  // --controller may stand behind the subcommand too
  add_options(*command, *arguments);
}

}  // namespace lfd
