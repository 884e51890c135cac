// lfd-calibrate map and ray: the calibrated map and its lines, one point a line from standard input.
#include <array>
#include <charconv>
#include <iostream>
#include <memory>

#include "base/log.h"
#include "cli/lfd_calibrate.h"
#include "proto/calibration_file.h"

namespace lfd {
namespace {

struct MapOptions {
  std::string file;
  int module = 0;
};

// Exactly kCount numbers, parted by blanks.
template <std::size_t kCount>
std::optional<std::array<double, kCount>> parse_numbers(std::string_view line) {
  constexpr std::string_view kBlanks = " \t\r";
  std::array<double, kCount> numbers{};
  for (double& number : numbers) {
    line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
    const std::string_view word = line.substr(0, line.find_first_of(kBlanks));
    const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
    const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (failure != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
    line.remove_prefix(word.size());
  }
  if (line.find_first_not_of(kBlanks) != line.npos) return std::nullopt;
  return numbers;
}

std::string map_line(const DisplayCalibration& display, const ModuleCalibration& module, std::array<double, 3> in) {
  const auto p = image_from_physical(display, module, {in[0], in[1], in[2]});
  return p ? fmt::format("{:.17g} {:.17g} {:.17g}", p->u, p->v, p->z) : "none";
}

std::string ray_line(const DisplayCalibration& display, const ModuleCalibration& module, std::array<double, 2> in) {
  const auto line = pixel_line(display, module, {in[0], in[1]});
  if (!line) return "none";
  const auto &s = line->on_screen, &o = line->on_observer_line;
  return fmt::format("{:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}", s.x, s.y, s.z, o.x, o.y, o.z);
}

// Answers every line of standard input at once, so that a partner can ask one thing after the other.
template <std::size_t kCount>
int answer_lines(const MapOptions& options, const char* expected,
                 std::string (*answer)(const DisplayCalibration&, const ModuleCalibration&,
                                       std::array<double, kCount>)) {
  const auto display = load_calibration(options.file);
  if (!display) return fail(display.error());
  const int modules = static_cast<int>(display->modules.size());
  if (options.module < 0 || options.module >= modules) {
    return wrong_use(Error(fmt::format("--module {}: the display has modules 0 to {}", options.module, modules - 1)));
  }
  const ModuleCalibration& module = display->modules[static_cast<std::size_t>(options.module)];
  std::string line;
  for (int number = 1; std::getline(std::cin, line); ++number) {
    const auto numbers = parse_numbers<kCount>(line);
    if (!numbers) return fail(Error(fmt::format("standard input:{}: \"{}\": {} is expected", number, line, expected)));
    std::cout << answer(*display, module, *numbers) << std::endl;
    if (!std::cout) return end_of_output();
  }
  return kExitDone;
}

void add_options(CLI::App& command, MapOptions& options) {
  command.add_option("FILE", options.file, "Calibration file (*.textproto)")->required();
  command.add_option("--module", options.module, "Number of the module, from 0, in the order of the file")
      ->required()
      ->type_name("K");
}

}  // namespace

void add_map_command(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<MapOptions>();
  CLI::App* command = add_command(app, "map", "Read `x y z` lines (physical, m); print `u v z` (px, px, m) or `none`",
                                  exit_code, [options] { return answer_lines<3>(*options, "x y z", map_line); });
  add_options(*command, *options);
}

void add_ray_command(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<MapOptions>();
  CLI::App* command =
      add_command(app, "ray",
                  "Read `u v` lines (px); print the pixel's line as `sx sy sz ox oy oz` (on the screen, on the "
                  "observer line) or `none`",
                  exit_code, [options] { return answer_lines<2>(*options, "u v", ray_line); });
  add_options(*command, *options);
}

}  // namespace lfd
