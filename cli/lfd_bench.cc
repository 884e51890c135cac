// lfd bench: error against run time, measured.
#include <iostream>
#include <memory>

#include "base/file.h"
#include "base/log.h"
#include "bench/frame/frame_bench.h"
#include "bench/frame/print.h"
#include "bench/stability/suite.h"
#include "cli/lfd_commands.h"

namespace lfd {
namespace {

struct Arguments {
  bench::FrameBenchOptions options;
  std::string scene, display;  // files instead of the deployment's; may be empty
  std::vector<double> roi;     // centre and edge lengths; may be empty
  std::filesystem::path out;
  bool json = false;
};

void set_vector(proto::Vector& to, double x, double y, double z) {
  to.set_x(x);
  to.set_y(y);
  to.set_z(z);
}

Status write_all(const std::filesystem::path& folder, const bench::FrameTable& table) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) return Error(failed.message()).within(folder.string());
  LFD_TRY_STATUS(write_file(folder / "frame.txt", bench::text_of(table)));
  LFD_TRY_STATUS(write_file(folder / "frame.csv", bench::csv_of(table)));
  return write_file(folder / "frame.json", bench::json_of(table));
}

int bench_frame(Arguments& a) {
  if (!a.scene.empty()) a.options.overrides.scene = a.scene;
  if (!a.display.empty()) a.options.overrides.display = a.display;
  if (!a.roi.empty()) {
    proto::RegionOfInterest& roi = a.options.roi.emplace();
    set_vector(*roi.mutable_world_centre(), a.roi[0], a.roi[1], a.roi[2]);
    set_vector(*roi.mutable_world_size(), a.roi[3], a.roi[4], a.roi[5]);
  }
  const auto table = bench::frame_bench(a.options);
  if (!table) return fail(table.error());
  std::cout << (a.json ? bench::json_of(*table) : bench::text_of(*table));
  if (a.out.empty()) return kExitDone;
  const Status written = write_all(a.out, *table);
  return written ? kExitDone : fail(written.error());
}

struct StabilityArguments {
  int gpu = -1;
  std::filesystem::path out;
  bool json = false;
};

int bench_stability(const StabilityArguments& a) {
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
  return table->missed().empty() ? kExitDone : kExitFailed;
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

void add_bench_command(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  Arguments& a = *arguments;
  CLI::App* bench = app.add_subcommand("bench", "Measure run time and error");
  bench->require_subcommand(1);
  CLI::App* frame = add_command(*bench, "frame", "Time one module's frames without and with ambient occlusion",
                                exit_code, [arguments] { return bench_frame(*arguments); });
  frame->add_option("DEPLOYMENT", a.options.deployment, "Deployment file (*.textproto)")->required();
  frame->add_option("--frames", a.options.frames, "How many frames of each kind")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  frame->add_option("--module", a.options.module, "Number of the module (default: the middle one)");
  frame->add_option("--scene", a.scene, "Show this glTF file instead of the deployment's scene");
  frame->add_option("--display", a.display, "Use this calibration file instead of the deployment's");
  frame
      ->add_option("--roi", a.roi,
                   "Region of interest in the world: cx,cy,cz,sx,sy,sz (centre and edge lengths, metres)")
      ->delimiter(',')
      ->expected(6);
  frame->add_option("--gpu", a.options.gpu, "Number in lfd-rendernode --list-gpus (default: the first that works)");
  frame->add_option("--ao-pixels", a.options.ao_subset.pixels, "Pixels whose ambient occlusion is judged")
      ->check(CLI::Range(0, 100000000))
      ->capture_default_str();
  frame->add_option("--ao-samples", a.options.ao_subset.samples, "Reference samples for each of them")
      ->check(CLI::Range(1, 10000000))
      ->capture_default_str();
  frame->add_option("--ao-seed", a.options.ao_subset.seed, "Seed of both choices")->capture_default_str();
  frame->add_option("--out", a.out, "Folder for frame.txt, frame.csv and frame.json");
  frame->add_flag("--json", a.json, "Print JSON instead of the table");
  add_bench_stability(*bench, exit_code);
}

}  // namespace lfd
