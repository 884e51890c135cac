// lfd bench cluster: what a cluster costs, by the number of its nodes.
#include <iostream>
#include <memory>

#include "base/file.h"
#include "base/log.h"
#include "bench/cluster/cluster_bench.h"
#include "cli/lfd_bench.h"
#include "cli/lfd_commands.h"

namespace lfd {
namespace {

struct Arguments {
  bench::ClusterBenchOptions options;
  std::filesystem::path out;
};

int end(const bench::ClusterTable& table) {
  const int printed = end_of_output();
  return bench::missed_bound(table).empty() ? printed : kExitFailed;
}

int bench_cluster(const Arguments& a) {
  StopSignals signals;
  start_log("lfd", "warn");
  if (!a.out.empty()) {
    if (const Status folder = make_folder(a.out); !folder) return fail(folder.error());
  }
  const auto table = bench::cluster_bench(a.options, signals, [](const bench::ClusterRow& row) {
    std::cerr << fmt::format("{} nodes, {} modules, {}: shown after {:.2f} ms, controller {:.0f} us a frame", row.nodes,
                             row.modules, row.scene, row.shown_median_ms, row.controller_us)
              << std::endl;
  });
  if (!table) return fail(table.error());
  std::cout << bench::text_of(*table);
  if (a.out.empty()) return end(*table);
  for (const auto& [name, content] :
       {std::pair{"cluster.md", bench::text_of(*table)}, std::pair{"cluster.csv", bench::csv_of(*table)},
        std::pair{"cluster.svg", bench::svg_of(*table)}}) {
    if (const Status written = write_file(a.out / name, content); !written) return fail(written.error());
  }
  return end(*table);
}

}  // namespace

void add_bench_cluster(CLI::App& bench, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  Arguments& a = *arguments;
  CLI::App* cluster = add_command(
      bench, "cluster",
      "Run virtual clusters of ever more nodes: latency, and what a frame costs the controller; exit code 1 where that "
      "grows with what rests in the scene (of two numbers of those or more, the last line is the verdict)",
      exit_code, [arguments] { return bench_cluster(*arguments); });
  cluster->add_option("--nodes", a.options.nodes, "Numbers of nodes")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(whole_number_within(1, 64))
      ->capture_default_str();
  cluster->add_option("--modules", a.options.modules, "Numbers of modules of the display")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(whole_number_within(2, 256))
      ->capture_default_str();
  cluster
      ->add_option("--scene", a.options.scenes,
                   "Made scenes (lfd-scene list); all but the first are shown to one cluster only")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str();
  cluster
      ->add_option("--resting", a.options.resting,
                   "Numbers of instances at rest of scenes in which a few move, shown to one cluster only")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(whole_number_within(0, 100000))
      ->capture_default_str();
  cluster->add_option("--crowd-frames", a.options.crowd_frames, "How many frames of each of those scenes")
      ->check(whole_number_within(10, 10000))
      ->capture_default_str();
  cluster->add_option("--frames", a.options.frames, "How many frames of each cluster")
      ->check(whole_number_within(10, 10000))
      ->capture_default_str();
  cluster->add_option("--out", a.out, "Folder for cluster.md, cluster.csv and cluster.svg");
}

}  // namespace lfd
