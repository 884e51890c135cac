// lfd-calibrate check: a calibration's numbers, and whether it is accepted.
#include "cli/lfd_calibrate_check.h"

#include <cmath>
#include <iostream>
#include <memory>
#include <numbers>

#include "base/log.h"
#include "cli/lfd_calibrate.h"
#include "cli/plots/check_plots.h"
#include "proto/calibration_file.h"

namespace lfd {
namespace {

void print_line(std::string_view what, const std::string& value) {
  std::cout << fmt::format("{:<22}{}\n", what, value);
}

std::string percent(double share) { return fmt::format("{:.2f} %", 100 * share); }
double degrees(double angle_rad) { return angle_rad * 180 / std::numbers::pi; }

// "0.12 % (most in module 3: 5 %)"
std::string share_line(const CalibrationReport& report, double MapNumbers::*field) {
  const int worst = report.worst_by(field);
  const double most = report.modules[static_cast<std::size_t>(worst)].*field;
  if (!(most > 0)) return "none";
  return fmt::format("{} (most in module {}: {})", percent(report.all.*field), worst, percent(most));
}

void print_maps(const CalibrationReport& report) {
  const MapNumbers& all = report.all;
  print_line("round trip, px", fmt::format("median {:.3g}, 99.9 % {:.3g}, max {:.3g} (module {})",
                                           all.round_trip_median_px, all.round_trip_999_px, all.round_trip_max_px,
                                           report.worst_by(&MapNumbers::round_trip_max_px)));
  print_line("image on screen", percent(all.image_on_screen));
  print_line("image without a map", share_line(report, &MapNumbers::image_unmapped));
  print_line("mirrored", share_line(report, &MapNumbers::mirrored));
  print_line("near singular", share_line(report, &MapNumbers::near_singular));
  print_line("grid cells folded", share_line(report, &MapNumbers::folded));
  print_line("grid cells in holes", share_line(report, &MapNumbers::incomplete));
  const std::string where = report.sampling.roi ? "in the region of interest"
                                                : fmt::format("within {:.3g} m of the screen", report.half_depth_m);
  print_line("condition number",
             fmt::format("median {:.3g}, 99 % {:.3g}, max {:.3g} (module {}), {}", all.condition_median,
                         all.condition_99, all.condition_max, report.worst_by(&MapNumbers::condition_max), where));
  const int darkest = report.least_covering();
  print_line("coverage of screen", fmt::format("mean {}, least {} (module {}), by any module {}", percent(all.coverage),
                                               percent(report.modules[static_cast<std::size_t>(darkest)].coverage),
                                               darkest, percent(report.coverage_any)));
}

std::string spacing_line(const std::optional<AngularSpacing>& spacing) {
  if (!spacing) return "none: all emitters in one direction";
  return fmt::format("min {:.3f}, median {:.3f}, max {:.3f} degrees", degrees(spacing->min_rad),
                     degrees(spacing->median_rad), degrees(spacing->max_rad));
}

void print_angles(const AngularReport& angles) {
  constexpr const char* kOrders[] = {"left to right", "right to left", "mixed"};
  print_line("emitters from centre", spacing_line(angles.from_centre));
  print_line("  from left border", spacing_line(angles.from_left));
  print_line("  from right border", spacing_line(angles.from_right));
  print_line("order of modules", kOrders[static_cast<int>(angles.order)]);
  for (const AngularGap& gap : angles.gaps) {
    print_line("gap", fmt::format("{:.3f} degrees between modules {} and {}", degrees(gap.angle_rad), gap.left_module,
                                  gap.right_module));
  }
  const std::string rule = angles.scattering_over_rule
                               ? fmt::format(", {:.3g} x the rule of 1.5 x spacing", *angles.scattering_over_rule)
                               : "";
  print_line("angular scattering", fmt::format("{:.3f} degrees{}", degrees(angles.scattering_rad), rule));
  if (angles.gap_over_scattering) {
    print_line("largest angle", fmt::format("{:.3g} x the scattering", *angles.gap_over_scattering));
  }
}

void print_depth(const std::optional<DepthBudget>& depth) {
  if (!depth) return;
  print_line("depth budget", fmt::format("spot {:.3g} mm on the screen, twice that {:.3g} m before and behind it",
                                         1e3 * depth->spot_on_screen_m, depth->doubled_at_m));
  std::string distances, spots;
  for (const DepthBudget::Spot& spot : depth->spots) {
    distances += fmt::format("{:>8.3g}", spot.distance_m);
    spots += fmt::format("{:>8.3g}", 1e3 * spot.spot_m);
  }
  print_line("  distance, m", distances);
  print_line("  spot, mm", spots);
}

void print_modules(const CalibrationReport& report) {
  std::cout << fmt::format("\n{:>6} {:>14} {:>10} {:>10} {:>10} {:>9} {:>9} {:>9} {:>10} {:>10} {:>10}\n", "module",
                           "round trip px", "on screen", "no map", "mirrored", "singular", "folded", "holes",
                           "cond. 50 %", "cond. max", "coverage");
  for (std::size_t k = 0; k < report.modules.size(); ++k) {
    const MapNumbers& m = report.modules[k];
    std::cout << fmt::format("{:>6} {:>14.3g} {:>10} {:>10} {:>10} {:>9} {:>9} {:>9} {:>10.3g} {:>10.3g} {:>10}\n", k,
                             m.round_trip_max_px, percent(m.image_on_screen), percent(m.image_unmapped),
                             percent(m.mirrored), percent(m.near_singular), percent(m.folded), percent(m.incomplete),
                             m.condition_median, m.condition_max, percent(m.coverage));
  }
  std::cout << "\n";
}

// Of --roi: absent where it was not given.
Result<std::optional<PhysicalBox>> roi_of(const std::vector<double>& numbers) {
  if (numbers.empty()) return std::optional<PhysicalBox>();
  for (std::size_t i = 0; i < 6; ++i) {
    if (!std::isfinite(numbers[i]) || (i > 2 && !(numbers[i] > 0))) {
      return Error(
          fmt::format("--roi: number {}: {:g}; finite numbers are needed, edge lengths above 0", i + 1, numbers[i]));
    }
  }
  return std::optional(PhysicalBox{{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}});
}

int run_check(const CheckOptions& options) {
  const auto roi = roi_of(options.roi);
  if (!roi) return wrong_use(roi.error());
  const auto display = load_calibration(options.file);
  if (!display) return fail(display.error());
  const int modules = static_cast<int>(display->modules.size());
  if (options.plot_module && *options.plot_module >= modules) {
    return wrong_use(
        Error(fmt::format("--module: {}; the display has modules 0 to {}", *options.plot_module, modules - 1)));
  }
  CheckSampling sampling = kThoroughSampling;
  sampling.roi = *roi;
  const auto report = check_calibration(*display, options.depth_m.value_or(default_half_depth_m(*display)), sampling);
  const auto missed = missed_limits(report, options.limits);
  if (options.json) {
    std::cout << check_json(*display, report, options.limits);
  } else {
    print_maps(report);
    print_angles(report.angles);
    print_depth(report.depth);
    if (options.per_module) print_modules(report);
    print_line("verdict", missed.empty() ? "accepted" : "refused");
  }
  if (!options.plot_folder.empty()) {
    const auto plotted = write_check_plots(options.plot_folder, *display, report, options.plot_module);
    if (!plotted) return fail(plotted.error());
  }
  std::cout << std::flush;
  for (const std::string& limit : missed) std::cerr << "missed: " << limit << "\n";
  return missed.empty() ? kExitDone : kExitFailed;
}

void add_limits(CLI::App& command, AcceptanceLimits& limits) {
  const auto add = [&command](const char* name, double& limit, const char* what) {
    command.add_option(name, limit, what)->capture_default_str()->check(number_within(0, 1e300))->group("Limits");
  };
  add("--max-round-trip-px", limits.round_trip_max_px, "Round trip image, screen, image: its maximum");
  add("--max-mirrored", limits.mirrored, "Share of a module's image that is mirrored, of 1");
  add("--max-singular", limits.near_singular, "Share of a module's image that is squeezed 1000 times one way");
  add("--max-folded", limits.folded, "Share of a grid's cells that have folded anywhere in them");
  add("--max-unmapped", limits.image_unmapped, "Share of a module's image without a map: holes, folds, beside a grid");
  add("--max-holes", limits.incomplete, "Share of a grid's cells that lack a corner");
  add("--max-condition", limits.condition_max, "Condition number of d(image)/d(physical)");
  add("--min-coverage", limits.coverage_least, "Share of the screen that each module lights");
  add("--max-gap", limits.gap_over_scattering,
      "Largest angle between neighbouring emitters over the angular scattering, which has to bridge it: 2/3 by the "
      "rule "
      "of thumb, 4/3 where a module is missing");
  add("--min-depth", limits.depth_least_m,
      "How far from the screen the spot of a ray may be twice that on it, m, at the least; 0 asks for nothing, since "
      "pixels and number of modules decide it");
}

}  // namespace

void add_check_command(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<CheckOptions>();
  CLI::App* command = add_command(app, "check", "Measure a calibration; exit code 1 where it misses a limit", exit_code,
                                  [options] { return run_check(*options); });
  command->add_option("FILE", options->file, "Calibration file (*.textproto)")->required();
  command
      ->add_option("--depth", options->depth_m,
                   "How far before and behind the screen the condition number is taken, m; without it a quarter of the "
                   "screen's width, at most half the way to emitters and observers")
      ->check(number_within(1e-12, 1e12))
      ->type_name("M");
  command
      ->add_option(
          "--roi", options->roi,
          "Take the condition number in this box instead, a deployment's region of interest in physical space: "
          "cx,cy,cz,sx,sy,sz (centre and edge lengths, m; the screen's centre is 0,0,0)")
      ->delimiter(',')
      ->expected(6)
      ->excludes("--depth");
  command->add_flag("--json", options->json,
                    "Everything as one JSON object: accepted, missed, limits, half_depth_m, roi, all, worst_module, "
                    "coverage_any, "
                    "pixel_width_m, angles, depth, modules; null for what is infinite or absent");
  command->add_flag("--per-module", options->per_module, "A table of all modules as well");
  command->add_option("--plot", options->plot_folder, "Write pictures (SVG) into this folder")->type_name("DIR");
  command->add_option("--module", options->plot_module, "The module that pictures of one show; without it the worst")
      ->check(CLI::NonNegativeNumber);
  add_limits(*command, options->limits);
}

}  // namespace lfd
