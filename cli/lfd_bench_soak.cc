// lfd bench soak: does a cluster survive?
#include <iostream>
#include <memory>

#include "base/file.h"
#include "base/log.h"
#include "bench/soak/soak.h"
#include "cli/lfd_bench.h"
#include "cli/lfd_commands.h"

namespace lfd {
namespace {

struct Arguments {
  bench::SoakOptions options;
  int faults = 0;
  std::filesystem::path out;
  bool quiet = false;
};

int bench_soak(const Arguments& a) {
  StopSignals signals;
  start_log("lfd", "warn");
  bench::SoakOptions options = a.options;
  if (a.faults > 0) options.faults = a.faults;
  const auto table = bench::soak(options, signals, [&a](const std::string& line) {
    if (!a.quiet) std::cerr << line << std::endl;
  });
  if (!table) return fail(table.error());
  std::cout << bench::text_of(*table);
  if (!a.out.empty()) {
    if (const Status written = write_file(a.out, bench::text_of(*table)); !written) return fail(written.error());
  }
  const int printed = end_of_output();
  return table->broken.empty() ? printed : table->exit_code();
}

}  // namespace

void add_bench_soak(CLI::App& bench, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  Arguments& a = *arguments;
  CLI::App* soak =
      add_command(bench, "soak",
                  "Run a small cluster through random faults; exit code 1 where a bound is broken, the last "
                  "line is the verdict",
                  exit_code, [arguments] { return bench_soak(*arguments); });
  soak->add_option("--minutes", a.options.minutes, "How long")->check(CLI::Range(0.1, 100000.0))->capture_default_str();
  soak->add_option("--faults", a.faults, "So many faults, however long they take, instead of --minutes")
      ->check(whole_number_within(1, 1000000));
  soak->add_option("--seed", a.options.seed, "Decides which faults come, and when")
      ->check(seed_number())
      ->capture_default_str();
  soak->add_option("--out", a.out, "Write the table to this file too");
  soak->add_flag("--quiet", a.quiet, "Only the table, no line for each fault");
}

}  // namespace lfd
