// The table of clusters as Markdown and CSV.
#include <algorithm>
#include <utility>

#include "base/log.h"
#include "bench/cluster/cluster_bench.h"
#include "bench/common/csv.h"

namespace lfd::bench {
namespace {

std::string line_of(const ClusterRow& row) {
  return fmt::format(
      "| {} | {} | {} | {:.1f} | {:.0f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.0f} | {:.0f} | {:.0f} | {:.0f} | "
      "{:.1f} |\n",
      row.modules, row.nodes, row.scene, row.scene_bytes / 1e6, row.frames_per_s, row.swap_median_ms, row.swap_99_ms,
      row.shown_median_ms, row.shown_99_ms, row.controller_us, row.at_rest_us, row.state_bytes, row.report_bytes,
      row.image_bytes / 1e3);
}

constexpr const char* kHead =
    "| modules | nodes | scene | scene MB | frames/s | swap ms | 99 % | shown ms | 99 % | controller us | at rest us/s "
    "| state B | "
    "reports B | "
    "images kB |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";

}  // namespace

std::string text_of(const ClusterTable& table) {
  std::string text = kHead;
  for (const ClusterRow& row : table.rows) text += line_of(row);
  for (const int modules : table.options.modules) {
    const Line line = table.controller_line(modules);
    text += fmt::format("\nThe controller's time per frame, {} modules: {:.0f} us + {:.0f} us per node.", modules,
                        line.constant, line.per_node);
  }
  text += "\n";
  for (const auto* rows : {&table.by_scene, &table.by_rest}) {
    if (rows->empty()) continue;
    text += std::string("\n") + kHead;
    for (const ClusterRow& row : *rows) text += line_of(row);
  }
  if (table.by_rest.size() < 2) return text;
  const std::string missed = missed_bound(table);
  return text + (missed.empty()
                     ? fmt::format("\nkept: what rests makes a frame cost the controller at most {} times as much\n",
                                   kMostGrowth)
                     : fmt::format("\nmissed: {}\n", missed));
}

std::string missed_bound(const ClusterTable& table) {
  if (table.by_rest.size() < 2) return "";
  const auto [few, many] = std::ranges::minmax_element(table.by_rest, {}, &ClusterRow::resting);
  for (const auto& [what, cost] :
       {std::pair{"us of the controller", &ClusterRow::controller_us}, {"bytes published", &ClusterRow::state_bytes}}) {
    if ((*many).*cost <= kMostGrowth * ((*few).*cost)) continue;
    return fmt::format(
        "a frame takes {:.0f} {} where {} instances rest, {:.0f} where {} do; at most {} times as much "
        "is wanted",
        (*many).*cost, what, *many->resting, (*few).*cost, *few->resting, kMostGrowth);
  }
  return "";
}

std::string csv_of(const ClusterTable& table) {
  std::string csv =
      "series,modules,nodes,scene,scene_bytes,frames_per_s,swap_median_ms,swap_99_ms,shown_median_ms,shown_99_ms,"
      "controller_us,at_rest_us_per_s,state_bytes,report_bytes,image_bytes\n";
  const auto add = [&](const char* series, const ClusterRow& row) {
    csv += fmt::format("{},{},{},{},{:.0f},{:.2f},{:.3f},{:.3f},{:.3f},{:.3f},{:.1f},{:.1f},{:.1f},{:.1f},{:.0f}\n",
                       series, row.modules, row.nodes, csv_cell(row.scene), row.scene_bytes, row.frames_per_s,
                       row.swap_median_ms, row.swap_99_ms, row.shown_median_ms, row.shown_99_ms, row.controller_us,
                       row.at_rest_us, row.state_bytes, row.report_bytes, row.image_bytes);
  };
  for (const ClusterRow& row : table.rows) add("nodes", row);
  for (const ClusterRow& row : table.by_scene) add("scenes", row);
  for (const ClusterRow& row : table.by_rest) add("rest", row);
  return csv;
}

}  // namespace lfd::bench
