// lfd-calibrate info: what a calibration is.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <numbers>
#include <variant>

#include "base/log.h"
#include "cli/color_text.h"
#include "cli/lfd_calibrate.h"
#include "proto/calibration_file.h"

namespace lfd {
namespace {

void print_line(std::string_view what, const std::string& value) {
  std::cout << fmt::format("{:<22}{}\n", what, value);
}

std::string kinds_of_maps(const DisplayCalibration& display) {
  constexpr const char* kNames[] = {"ideal", "homography", "pinhole", "grid"};
  static_assert(std::size(kNames) == std::variant_size_v<ScreenMap>);
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

std::string shape_of_screen(const Optics& optics) {
  if (optics.screen_radius_m == 0) return "planar";
  return fmt::format("{} cylinder, radius {} m", optics.screen_radius_m > 0 ? "convex" : "concave",
                     std::abs(optics.screen_radius_m));
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
  print_line("screen", fmt::format("{} x {} m, {}", display->screen.width_m, display->screen.height_m,
                                   shape_of_screen(display->optics)));
  print_line("diffuser", display->optics.diffuser == Diffuser::kLinear ? "linear" : "conical");
  print_line(display->optics.observer_arc ? "observer arc" : "observer line",
             fmt::format("height {} m, distance {} m", display->optics.observer_height_m,
                         display->optics.observer_distance_m));
  print_line("emitters x", span_of(*display, &Point3<Physical>::x));
  print_line("emitters y", span_of(*display, &Point3<Physical>::y));
  print_line("emitters z", span_of(*display, &Point3<Physical>::z));
  print_line("angular scattering", fmt::format("{:.6g} rad ({:.4g} degrees)", display->angular_scattering_rad,
                                               display->angular_scattering_rad * 180 / std::numbers::pi));
  print_line("colour", color_text(*display));
  print_line("hash", calibration_hash(*display));
  return end_of_output();
}

}  // namespace

void add_info_command(CLI::App& app, int& exit_code) {
  const auto file = std::make_shared<std::string>();
  CLI::App* command = add_command(app, "info", "Describe a calibration", exit_code, [file] { return run_info(*file); });
  command->add_option("FILE", *file, "Calibration file (*.textproto)")->required();
}

}  // namespace lfd
