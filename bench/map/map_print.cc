// The table as text, CSV and JSON, and what follows from it.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/log.h"
#include "bench/common/csv.h"
#include "bench/map/map_bench.h"

namespace lfd::bench {
namespace {

// Names in the order of their wall-clock ratio, the cheapest first; of several modules the worst counts.
std::vector<std::pair<double, std::string>> by_cost(const MapTable& table) {
  std::vector<std::pair<double, std::string>> costs;
  for (const MapRow& row : table.rows) {
    const auto known = std::ranges::find(costs, row.variant, &std::pair<double, std::string>::second);
    if (known == costs.end()) {
      costs.emplace_back(row.wall_ratio, row.variant);
    } else {
      known->first = std::max(known->first, row.wall_ratio);
    }
  }
  std::ranges::sort(costs);
  return costs;
}

// The cheapest way that keeps all bounds, and the next cheaper one with what it misses.
std::string verdict(const MapTable& table) {
  std::string cheaper;
  for (const auto& [ratio, variant] : by_cost(table)) {
    const auto missed = missed_bounds(table, variant);
    if (missed.empty()) {
      const std::string chosen =
          fmt::format("cheapest that keeps all bounds: {} ({:.2f} x plain vertices)\n", variant, ratio);
      return chosen + (cheaper.empty() ? "" : "next cheaper: " + cheaper);
    }
    cheaper = fmt::format("{} ({:.2f} x), which misses:\n", variant, ratio);
    for (const std::string& line : missed) cheaper += "  " + line + "\n";
  }
  return "none keeps all bounds\n";
}

}  // namespace

std::string text_of(const MapTable& table) {
  std::string text =
      fmt::format("scene {}, display {}, {} x {} px, {} frames of each in turn\n{}, program {}\n\n", table.scene,
                  table.display, table.image.width, table.image.height, table.frames, table.renderer, table.version);
  text += fmt::format("{:<48} {:>6} {:>9} {:>8} {:>8} {:>6} {:>6} {:>8} {:>8} {:>8} {:>8} {:>9}\n", "way of drawing",
                      "module", "triangles", "gpu ms", "wall ms", "gpu x", "wall x", "median", "99 %", "99.9 %", "max",
                      "coverage");
  for (const MapRow& r : table.rows) {
    text += fmt::format(
        "{:<48} {:>6} {:>9} {:>8.1f} {:>8.1f} {:>6.2f} {:>6.2f} {:>8.1e} {:>8.1e} {:>8.1e} {:>8.1e} {:>9.1e}\n",
        r.variant, r.module, r.triangles, r.gpu_ms, r.wall_ms, r.gpu_ratio, r.wall_ratio, r.truth.median,
        r.truth.percent_99, r.truth.percent_999, r.truth.max, r.truth.mismatch_share);
  }
  return text + "\n" + verdict(table);
}

std::string csv_of(const MapTable& table) {
  std::string csv =
      "scene,display,module,variant,triangles,build_ms,gpu_ms,wall_ms,gpu_ratio,wall_ratio,median,percent_99,"
      "percent_999,max,mismatch_share,compared\n";
  for (const MapRow& r : table.rows) {
    csv += fmt::format("{},{},{},{},{},{:.3f},{:.3f},{:.3f},{:.4f},{:.4f},{:.4e},{:.4e},{:.4e},{:.4e},{:.4e},{}\n",
                       csv_cell(table.scene), csv_cell(table.display), r.module, csv_cell(r.variant), r.triangles,
                       r.build_ms, r.gpu_ms, r.wall_ms, r.gpu_ratio, r.wall_ratio, r.truth.median, r.truth.percent_99,
                       r.truth.percent_999, r.truth.max, r.truth.mismatch_share, r.truth.compared);
  }
  return csv;
}

std::string json_of(const MapTable& table) {
  nlohmann::ordered_json json{{"scene", table.scene},
                              {"display", table.display},
                              {"width_px", table.image.width},
                              {"height_px", table.image.height},
                              {"roi_diagonal_m", table.roi_diagonal_m},
                              {"renderer", table.renderer},
                              {"version", table.version},
                              {"frames", table.frames}};
  for (const MapRow& r : table.rows) {
    json["rows"].push_back({{"variant", r.variant},
                            {"module", r.module},
                            {"triangles", r.triangles},
                            {"build_ms", r.build_ms},
                            {"gpu_ms", r.gpu_ms},
                            {"wall_ms", r.wall_ms},
                            {"gpu_ratio", r.gpu_ratio},
                            {"wall_ratio", r.wall_ratio},
                            {"median", r.truth.median},
                            {"percent_99", r.truth.percent_99},
                            {"percent_999", r.truth.percent_999},
                            {"max", r.truth.max},
                            {"mismatch_share", r.truth.mismatch_share},
                            {"compared", r.truth.compared}});
  }
  json["verdict"] = verdict(table);
  return json.dump(2) + "\n";
}

}  // namespace lfd::bench
