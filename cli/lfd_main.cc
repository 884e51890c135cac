// lfd: the one command a person types to run, look at and control a light-field display.
#include "base/log.h"
#include "cli/lfd_commands.h"

int main(int argc, char** argv) {
  lfd::start_log("lfd", "info");
  CLI::App app("Runs, renders with, looks at and controls light-field displays.", "lfd");
  app.require_subcommand(1);
  app.footer("Exit codes: 0 done, 1 it failed, 2 wrong use. See also: lfd-calibrate, lfd-scene.");
  int exit_code = lfd::kExitDone;
  lfd::add_run_command(app, exit_code);
  lfd::add_render_command(app, exit_code);
  lfd::add_record_command(app, exit_code);
  lfd::add_replay_command(app, exit_code);
  lfd::add_view_command(app, exit_code);
  lfd::add_ctl_command(app, exit_code);
  lfd::add_keys_command(app, exit_code);
  lfd::add_bench_command(app, exit_code);
  return lfd::parse_command_line(app, argc, argv).value_or(exit_code);
}
