// lfd-calibrate info and check: what a calibration is, and whether it is accepted.
#include <algorithm>
#include <iostream>
#include <limits>
#include <memory>
#include <numbers>

#include "base/log.h"
#include "calibration/check.h"
#include "cli/color_text.h"
#include "cli/lfd_calibrate.h"
#include "proto/calibration_file.h"

namespace lfd {
namespace {

struct CheckOptions {
  std::string file;
  std::optional<double> depth_m;
  AcceptanceLimits limits;
};

void print_line(std::string_view what, const std::string& value) {
  std::cout << fmt::format("{:<22}{}\n", what, value);
}

std::string kinds_of_maps(const DisplayCalibration& display) {
  constexpr const char* kNames[] = {"ideal", "homography", "pinhole"};
  std::string text;
  for (std::size_t kind = 0; kind < std::size(kNames); ++kind) {
    const auto count = std::count_if(display.modules.begin(), display.modules.end(),
                                     [kind](const ModuleCalibration& module) { return module.map.index() == kind; });
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, kNames[kind]);
  }
  return text;
}

std::string span_of(const DisplayCalibration& display, double Point3<Physical>::*axis) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const ModuleCalibration& module : display.modules) {
    low = std::min(low, module.emitter.*axis);
    high = std::max(high, module.emitter.*axis);
  }
  return low == high ? fmt::format("{:.4g} m", low) : fmt::format("{:.4g} to {:.4g} m", low, high);
}

int run_info(const std::string& file) {
  const auto display = load_calibration(file);
  if (!display) return fail(display.error());
  const double megapixels =
      1e-6 * static_cast<double>(display->modules.size()) * display->image.width * display->image.height;
  print_line("name", display->name);
  print_line("modules", fmt::format("{} ({})", display->modules.size(), kinds_of_maps(*display)));
  print_line("image of each", fmt::format("{} x {} px, {:.3g} megapixels in all", display->image.width,
                                          display->image.height, megapixels));
  print_line("screen", fmt::format("{} x {} m", display->screen.width_m, display->screen.height_m));
  print_line("diffuser", display->optics.diffuser == Diffuser::kLinear ? "linear" : "conical");
  print_line("observer line", fmt::format("height {} m, distance {} m", display->optics.observer_height_m,
                                          display->optics.observer_distance_m));
  print_line("emitters x", span_of(*display, &Point3<Physical>::x));
  print_line("emitters y", span_of(*display, &Point3<Physical>::y));
  print_line("emitters z", span_of(*display, &Point3<Physical>::z));
  print_line("angular scattering", fmt::format("{:.6g} rad ({:.4g} degrees)", display->angular_scattering_rad,
                                               display->angular_scattering_rad * 180 / std::numbers::pi));
  print_line("colour", color_text(*display));
  print_line("hash", calibration_hash(*display));
  return kExitDone;
}

std::string percent(double share) { return fmt::format("{:.2f} %", 100 * share); }

int run_check(const CheckOptions& options) {
  const auto display = load_calibration(options.file);
  if (!display) return fail(display.error());
  const auto report = check_calibration(*display, options.depth_m.value_or(default_half_depth_m(*display)));
  print_line("round trip, px", fmt::format("median {:.3g}, 99.9 % {:.3g}, max {:.3g}", report.round_trip_median_px,
                                           report.round_trip_999_px, report.round_trip_max_px));
  print_line("image on screen", percent(report.image_on_screen));
  print_line("mirrored", percent(report.mirrored));
  print_line("near singular", percent(report.near_singular));
  print_line("condition number", fmt::format("median {:.3g}, max {:.3g}, within z = +-{:.3g} m",
                                             report.condition_median, report.condition_max, report.half_depth_m));
  print_line("coverage of screen",
             fmt::format("mean {}, least {} (module {}), by any module {}", percent(report.coverage_mean),
                         percent(report.coverage_least), report.coverage_least_module, percent(report.coverage_any)));
  const auto missed = missed_limits(report, options.limits);
  print_line("verdict", missed.empty() ? "accepted" : "refused");
  std::cout << std::flush;
  for (const std::string& limit : missed) std::cerr << "missed: " << limit << "\n";
  return missed.empty() ? kExitDone : kExitFailed;
}

}  // namespace

void add_info_command(CLI::App& app, int& exit_code) {
  const auto file = std::make_shared<std::string>();
  CLI::App* command = add_command(app, "info", "Describe a calibration", exit_code, [file] { return run_info(*file); });
  command->add_option("FILE", *file, "Calibration file (*.textproto)")->required();
}

void add_check_command(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<CheckOptions>();
  CLI::App* command = add_command(app, "check", "Measure a calibration; exit code 1 where it misses a limit", exit_code,
                                  [options] { return run_check(*options); });
  command->add_option("FILE", options->file, "Calibration file (*.textproto)")->required();
  command
      ->add_option("--depth", options->depth_m,
                   "Half depth of the box for the condition number, m; a quarter of the screen's width without it")
      ->check(CLI::PositiveNumber)
      ->type_name("M");
  command->add_option("--round-trip", options->limits.round_trip_max_px, "Limit of the round trip, px")
      ->capture_default_str();
  command->add_option("--condition", options->limits.condition_max, "Limit of the condition number")
      ->capture_default_str();
  command->add_option("--coverage", options->limits.coverage_least, "Least share of the screen that each module lights")
      ->capture_default_str();
}

}  // namespace lfd
