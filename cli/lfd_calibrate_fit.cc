// lfd-calibrate simulate and fit: observations made of a known display, and a calibration made of observations.
#include <filesystem>
#include <iostream>
#include <memory>
#include <tuple>

#include "base/file.h"
#include "base/log.h"
#include "calibration/fit/fit.h"
#include "calibration/fit/simulate.h"
#include "cli/fit_plots.h"
#include "cli/fit_report.h"
#include "cli/lfd_calibrate.h"
#include "proto/calibration_file.h"

namespace lfd {
namespace {

struct SimulateOptions {
  std::string display, out;
  std::string points = "24x18";
  SimulationOptions simulation;
};

struct FitCommandOptions {
  std::string observations, start, out;
  std::string plot_folder;  // empty: no pictures
  bool json = false, no_grids = false;
  FitOptions fit;
};

int run_simulate(SimulateOptions options) {
  const auto points = columns_and_rows("--points", options.points);
  if (!points) return wrong_use(points.error());
  std::tie(options.simulation.points_u, options.simulation.points_v) = *points;
  const auto display = load_calibration(options.display);
  if (!display) return fail(display.error());
  const auto made = simulate_observations(*display, options.simulation);
  if (!made) return wrong_use(made.error());
  if (made->observations.points.empty()) {
    return wrong_use(
        Error(fmt::format("no observation is left to write: --missing {} leaves out every point of every image",
                          options.simulation.missing)));
  }
  if (auto status = write_file(options.out, print_observations(made->observations)); !status) {
    return fail(status.error());
  }
  std::cout << fmt::format("{} observations, {} of them outliers\n", made->observations.points.size(),
                           made->outliers.size());
  return kExitDone;
}

int run_fit(const FitCommandOptions& options) {
  const auto start = load_calibration(options.start);
  if (!start) return fail(start.error());
  std::error_code none_there;
  if (std::filesystem::equivalent(options.out, options.observations, none_there))
    return wrong_use(Error(fmt::format("--out {}: would replace the observations", options.out)));
  const auto observations = load_observations(options.observations);
  if (!observations) return fail(observations.error());
  FitOptions fit = options.fit;
  fit.residual_grids = !options.no_grids;
  const auto fitted = fit_display(*start, *observations, fit);
  if (!fitted) return fail(fitted.error());
  if (auto status = save_calibration(options.out, fitted->display); !status) return fail(status.error());
  if (!options.plot_folder.empty()) {
    if (auto status = write_fit_plots(options.plot_folder, *fitted, *observations); !status) {
      return fail(status.error());
    }
  }
  std::cout << (options.json ? fit_json(*fitted, *observations) : fit_table(*fitted, *observations)) << std::flush;
  return std::cout ? kExitDone : fail(Error("standard output: cannot be written"));
}

}  // namespace

void add_simulate_command(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<SimulateOptions>();
  CLI::App* command = add_command(app, "simulate", "Make observations of a known display, as a camera would", exit_code,
                                  [options] { return run_simulate(*options); });
  SimulationOptions& simulation = options->simulation;
  command->add_option("DISPLAY", options->display, "Calibration file (*.textproto)")->required();
  command->add_option("--out", options->out, "CSV file to write: module,u,v,s,y[,sigma] in px and m")
      ->required()
      ->type_name("FILE");
  command->add_option("--noise-px", simulation.noise_px, "Standard deviation of u and of v, px")->capture_default_str();
  command->add_option("--outliers", simulation.outliers, "Share of observations that are displaced by 10 to 40 px")
      ->capture_default_str();
  command->add_option("--missing", simulation.missing, "Share of each image that is not seen: a rectangle or a disc")
      ->capture_default_str();
  command->add_option("--points", options->points, "Points over each image")->type_name("UxV")->capture_default_str();
  command->add_flag("--sigma", simulation.write_sigma, "Write the noise as each observation's sigma");
  command->add_option("--seed", simulation.seed, "Equal seeds give equal observations")
      ->check(seed_number())
      ->capture_default_str();
}

void add_fit_command(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<FitCommandOptions>();
  CLI::App* command =
      add_command(app, "fit", "Make a calibration of observations", exit_code, [options] { return run_fit(*options); });
  command->add_option("OBSERVATIONS", options->observations, "CSV file: module,u,v,s,y[,sigma] in px and m")
      ->required();
  command->add_option("--start", options->start, "Calibration file to start from: screen, optics, emitters, first maps")
      ->required()
      ->type_name("DISPLAY");
  command->add_option("--out", options->out, "Calibration file to write")->required()->type_name("FILE");
  command
      ->add_option("--plot", options->plot_folder, "Write a picture (SVG) of each module's residuals into this folder")
      ->type_name("DIR");
  command->add_flag("--json", options->json, "Report as JSON");
  command->add_flag("--no-grids", options->no_grids, "All modules stay pinholes, whatever they leave of the residuals");
  command
      ->add_option("--emitter-sd", options->fit.emitter_sd_m,
                   "How well the start knows the emitters: standard deviation along each axis, m; 0.5 % of their "
                   "distance without it")
      ->check(number_within(1e-12, 1e12))
      ->type_name("M");
  command->footer(
      "One optimisation over all modules, and the radius of a curved screen; then, where points held out say that it\n"
      "helps, a grid of smoothed residuals. Priors about the start decide what observations of a screen cannot: "
      "beside\n"
      "--emitter-sd, 1 degree for each turn, 2 % of the focal lengths, 3 % of the image's width for the principal "
      "point,\n"
      "1 to 3 % of it for what each lens coefficient moves the furthest corner, 20 % of the radius.\n"
      "The radius stays the start's where a module needs a grid: warps look like curvature.");
}

}  // namespace lfd
