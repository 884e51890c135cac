// lfd-calibrate: makes, imports, fits, checks and describes display calibrations, and answers where points land.
#include "cli/lfd_calibrate.h"

int main(int argc, char** argv) {
  CLI::App app("Makes, imports, fits, checks and describes the calibrations of light-field displays.", "lfd-calibrate");
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 1 it failed, 2 wrong use. Lengths are metres of physical space: x right as a viewer sees "
      "it,\n"
      "y up, z from the screen toward the viewer, origin at the screen's centre.");
  int exit_code = lfd::kExitDone;
  lfd::add_make_command(app, exit_code);
  lfd::add_import_command(app, exit_code);
  lfd::add_export_command(app, exit_code);
  lfd::add_simulate_command(app, exit_code);
  lfd::add_fit_command(app, exit_code);
  lfd::add_info_command(app, exit_code);
  lfd::add_check_command(app, exit_code);
  lfd::add_map_command(app, exit_code);
  lfd::add_ray_command(app, exit_code);
  return lfd::parse_command_line(app, argc, argv).value_or(exit_code);
}
