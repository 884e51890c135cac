// The table as text, CSV and JSON, and what follows from it.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/log.h"
#include "bench/common/csv.h"
#include "bench/map/map_bench.h"

namespace lfd::bench {
namespace {

// Names in the order of their cost_ratio() on the first scene, the cheapest first; of several modules the worst counts.
std::vector<std::pair<double, std::string>> by_cost(const MapTable& table) {
  std::vector<std::pair<double, std::string>> costs;
  for (const MapRow& row : table.rows) {
    if (row.scene != table.rows.front().scene) continue;
    const auto known = std::ranges::find(costs, row.variant, &std::pair<double, std::string>::second);
    if (known == costs.end()) {
      costs.emplace_back(cost_ratio(table, row).median, row.variant);
    } else {
      known->first = std::max(known->first, cost_ratio(table, row).median);
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
  std::string text = fmt::format("display {}, {} x {} px, {} frames of each in turn\n{}, lfd {}\n", table.display,
                                 table.image.width, table.image.height, table.frames, table.renderer, table.version);
  for (const std::string& scene : table.scenes()) {
    text += fmt::format("\n{:<48} {:>6} {:>9} {:>8} {:>8} {:>6} {:>15} {:>8} {:>8} {:>8} {:>8} {:>9} {:>9}\n", scene,
                        "module", "triangles", "gpu ms", "wall ms", "gpu x", "wall x (5, 95 %)", "median", "99 %",
                        "99.9 %", "max", "coverage", "table px");
    for (const MapRow& r : table.rows) {
      if (r.scene != scene) continue;
      const Spread& x = r.wall_ratio;
      text += fmt::format(
          "{:<48} {:>6} {:>9} {:>8.1f} {:>8.1f} {:>6.2f} {:>16} {:>8.1e} {:>8.1e} {:>8.1e} {:>8.1e} {:>9.1e} {:>9}\n",
          r.variant, r.module, r.triangles, r.gpu_ms.median, r.wall_ms.median, r.gpu_ratio.median,
          fmt::format("{:.2f} ({:.2f}, {:.2f})", x.median, x.percent_5, x.percent_95), r.truth.median,
          r.truth.percent_99, r.truth.percent_999, r.truth.max, r.truth.mismatch_share,
          r.table ? fmt::format("{:.1e}", r.table->error_px) : "-");
    }
  }
  return text + "\n" + verdict(table);
}

std::string csv_of(const MapTable& table) {
  std::string csv =
      "scene,display,module,variant,triangles,build_ms,frames,gpu_ms,wall_ms,gpu_ratio,wall_ratio,wall_ratio_5_percent,"
      "wall_ratio_95_percent,median,percent_99,percent_999,max,mismatch_share,compared,table_columns,table_error_px\n";
  for (const MapRow& r : table.rows) {
    csv += fmt::format(
        "{},{},{},{},{},{:.3f},{},{:.3f},{:.3f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4e},{:.4e},{:.4e},{:.4e},{:.4e},{},{},{}"
        "\n",
        csv_cell(r.scene), csv_cell(table.display), r.module, csv_cell(r.variant), r.triangles, r.build_ms,
        table.frames, r.gpu_ms.median, r.wall_ms.median, r.gpu_ratio.median, r.wall_ratio.median,
        r.wall_ratio.percent_5, r.wall_ratio.percent_95, r.truth.median, r.truth.percent_99, r.truth.percent_999,
        r.truth.max, r.truth.mismatch_share, r.truth.compared, r.table ? fmt::to_string(r.table->columns) : "",
        r.table ? fmt::format("{:.4e}", r.table->error_px) : "");
  }
  return csv;
}

std::string json_of(const MapTable& table) {
  nlohmann::ordered_json json{{"display", table.display},        {"width_px", table.image.width},
                              {"height_px", table.image.height}, {"renderer", table.renderer},
                              {"version", table.version},        {"frames", table.frames}};
  for (const MapRow& r : table.rows) {
    json["rows"].push_back({{"scene", r.scene},
                            {"roi_diagonal_m", r.roi_diagonal_m},
                            {"variant", r.variant},
                            {"module", r.module},
                            {"triangles", r.triangles},
                            {"build_ms", r.build_ms},
                            {"gpu_ms", r.gpu_ms.median},
                            {"wall_ms", r.wall_ms.median},
                            {"gpu_ratio", r.gpu_ratio.median},
                            {"wall_ratio", r.wall_ratio.median},
                            {"wall_ratio_5_percent", r.wall_ratio.percent_5},
                            {"wall_ratio_95_percent", r.wall_ratio.percent_95},
                            {"median", r.truth.median},
                            {"percent_99", r.truth.percent_99},
                            {"percent_999", r.truth.percent_999},
                            {"max", r.truth.max},
                            {"mismatch_share", r.truth.mismatch_share},
                            {"compared", r.truth.compared}});
    if (r.table) json["rows"].back()["table"] = {{"columns", r.table->columns}, {"error_px", r.table->error_px}};
  }
  json["verdict"] = verdict(table);
  return json.dump(2) + "\n";
}

}  // namespace lfd::bench
