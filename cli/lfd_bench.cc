// lfd bench: error against run time, measured.
#include <signal.h>
#include <unistd.h>

#include <iostream>
#include <memory>

#include "base/file.h"
#include "base/log.h"
#include "bench/frame/frame_bench.h"
#include "bench/frame/print.h"
#include "bench/map/map_bench.h"
#include "bench/stability/suite.h"
#include "cli/lfd_bench.h"
#include "cli/lfd_commands.h"
#include "proto/settings.h"

namespace lfd {
namespace {

struct Arguments {
  bench::FrameBenchOptions options;
  std::string scene, display;  // files instead of the deployment's; may be empty
  std::vector<double> roi;     // centre and edge lengths; may be empty
  std::filesystem::path out;
  bool json = false;
};

Status write_all(const std::filesystem::path& folder, const bench::FrameTable& table) {
  LFD_TRY_STATUS(write_file(folder / "frame.txt", bench::text_of(table)));
  LFD_TRY_STATUS(write_file(folder / "frame.csv", bench::csv_of(table)));
  return write_file(folder / "frame.json", bench::json_of(table));
}

int bench_frame(Arguments& a) {
  if (!a.scene.empty()) a.options.overrides.scene = a.scene;
  if (!a.display.empty()) a.options.overrides.display = a.display;
  if (!a.roi.empty()) {
    proto::RegionOfInterest& roi = a.options.roi.emplace();
    set_box(*roi.mutable_world_centre(), *roi.mutable_world_size(), a.roi);
  }
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::signal(signal, end_bench_by_signal);
  if (const Status possible = bench::check_options(a.options); !possible) return wrong_use(possible.error());
  if (!a.out.empty()) {
    if (const Status folder = make_folder(a.out); !folder) return fail(folder.error());
  }
  const auto table = bench::frame_bench(a.options);
  if (!table) return fail(table.error());
  std::cout << (a.json ? bench::json_of(*table) : bench::text_of(*table));
  if (a.out.empty()) return end_of_output();
  const Status written = write_all(a.out, *table);
  return written ? end_of_output() : fail(written.error());
}

struct MapArguments {
  bench::MapBenchOptions options;
  std::string display;  // a file instead of the deployment's; may be empty
  std::filesystem::path out;
};

int bench_map(MapArguments& a) {
  if (!a.display.empty()) a.options.overrides.display = a.display;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::signal(signal, end_bench_by_signal);
  if (const Status folder = make_folder(a.out); !folder) return fail(folder.error());
  const auto table = bench::map_bench(a.options);
  if (!table) return fail(table.error());
  std::cout << bench::text_of(*table);
  const auto write = [&](const std::string& name, const std::string& text) { return write_file(a.out / name, text); };
  for (const Status& written : {write("map.txt", bench::text_of(*table)), write("map.csv", bench::csv_of(*table)),
                                write("map.json", bench::json_of(*table))}) {
    if (!written) return fail(written.error());
  }
  for (const std::string& scene : table->scenes()) {
    const std::string stem = scene.substr(0, scene.find_first_of(". "));
    if (const Status plot = write("map-" + stem + ".svg", bench::svg_of(*table, scene)); !plot)
      return fail(plot.error());
  }
  return end_of_output();
}

void add_map_command(CLI::App& bench, int& exit_code) {
  auto arguments = std::make_shared<MapArguments>();
  MapArguments& a = *arguments;
  CLI::App* map = add_command(bench, "map", "Position error against run time, for every way of drawing", exit_code,
                              [arguments] { return bench_map(*arguments); });
  map->add_option("DEPLOYMENT", a.options.deployment, "Deployment file (*.textproto)")->required();
  map->add_option("--out", a.out, "Folder for map.txt, map.csv, map.json and map-SCENE.svg")->required();
  map->add_option("--frames", a.options.frames, "How many frames of each way, in turn")
      ->check(whole_number_within(1, 100000))
      ->capture_default_str();
  map->add_option("--module", a.options.modules, "Numbers of modules (default: the middle one, the first and the last)")
      ->delimiter(',')
      ->allow_extra_args(false);
  map->add_option("--scene", a.options.scenes,
                  "Show these glTF files, one after the other, instead of the deployment's scene; the bound in time is "
                  "for the first")
      ->delimiter(',')
      ->allow_extra_args(false);
  map->add_option("--display", a.display, "Use this calibration file instead of the deployment's");
  map->add_option("--gpu", a.options.gpu, "Number in lfd-rendernode --list-gpus (default: the first that works)");
}

struct StabilityArguments {
  int gpu = -1;
  std::filesystem::path out;
  bool json = false;
};

int bench_stability(const StabilityArguments& a) {
  if (!a.out.empty()) {
    if (const Status folder = make_folder(a.out); !folder) return fail(folder.error());
  }
  const auto table = bench::run_stability(a.gpu);
  if (!table) return fail(table.error());
  if (!a.out.empty()) {
    for (const auto& [name, content] :
         {std::pair{"stability.md", bench::text_of(*table)}, std::pair{"stability.csv", bench::csv_of(*table)},
          std::pair{"stability.json", bench::json_of(*table)}}) {
      if (const Status written = write_file(a.out / name, content); !written) return fail(written.error());
    }
  }
  std::cout << (a.json ? bench::json_of(*table) : bench::text_of(*table));
  const int printed = end_of_output();
  if (a.json) std::cerr << bench::verdict_of(*table) << "\n";
  return table->missed().empty() ? printed : kExitFailed;
}

void add_bench_stability(CLI::App& bench, int& exit_code) {
  auto arguments = std::make_shared<StabilityArguments>();
  CLI::App* stability =
      add_command(bench, "stability", "Run the cases at the driver's numerical edges; exit code 1 where one misses",
                  exit_code, [arguments] { return bench_stability(*arguments); });
  stability->add_option("--out", arguments->out, "Folder for stability.md, stability.csv and stability.json");
  stability->add_option("--gpu", arguments->gpu,
                        "Number in lfd-rendernode --list-gpus (default: the first that works)");
  stability->add_flag("--json", arguments->json, "Print JSON instead of the table");
}

}  // namespace

void end_bench_by_signal(int) {
  constexpr std::string_view kLine = "error: ended by a signal; nothing is written\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, kLine.data(), kLine.size());
  ::_exit(kExitFailed);
}

void add_bench_command(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  Arguments& a = *arguments;
  CLI::App* bench = app.add_subcommand("bench", "Measure run time and error");
  bench->require_subcommand(1);
  add_map_command(*bench, exit_code);
  CLI::App* frame = add_command(*bench, "frame", "Time one module's frames without and with ambient occlusion",
                                exit_code, [arguments] { return bench_frame(*arguments); });
  frame->add_option("DEPLOYMENT", a.options.deployment, "Deployment file (*.textproto)")->required();
  frame->add_option("--frames", a.options.frames, "How many frames of each kind")
      ->check(whole_number_within(1, 1000000))
      ->capture_default_str();
  frame->add_option("--module", a.options.module, "Number of the module (default: the middle one)");
  frame->add_option("--scene", a.scene, "Show this glTF file instead of the deployment's scene");
  frame->add_option("--display", a.display, "Use this calibration file instead of the deployment's");
  add_box(*frame, "--roi", a.roi, Box::kWorld,
          "Region of interest in the world: centre and edge lengths, metres; the whole scene without it");
  frame->add_option("--gpu", a.options.gpu, "Number in lfd-rendernode --list-gpus (default: the first that works)");
  frame->add_option("--ao-pixels", a.options.ao_subset.pixels, "Pixels whose ambient occlusion is judged")
      ->check(whole_number_within(0, 100000000))
      ->capture_default_str();
  frame->add_option("--ao-samples", a.options.ao_subset.samples, "Reference samples for each of them")
      ->check(whole_number_within(1, 10000000))
      ->capture_default_str();
  frame->add_option("--ao-seed", a.options.ao_subset.seed, "Seed of both choices")
      ->check(seed_number())
      ->capture_default_str();
  frame->add_option("--out", a.out, "Folder for frame.txt, frame.csv and frame.json");
  frame->add_flag("--json", a.json, "Print JSON instead of the table");
  add_bench_stability(*bench, exit_code);
  add_bench_ao(*bench, exit_code);
  add_bench_cluster(*bench, exit_code);
  add_bench_soak(*bench, exit_code);
  add_bench_stream(*bench, exit_code);
}

}  // namespace lfd
