// Reports of fits to JSON and to a table.
#include "cli/fit_report.h"

#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include "base/log.h"
#include "base/version.h"

namespace lfd {
namespace {

using Json = nlohmann::ordered_json;

Json summary_json(const ResidualSummary& summary) {
  return {{"median_px", summary.median_px}, {"quantile_99_px", summary.quantile_99_px}, {"max_px", summary.max_px}};
}

Json module_json(std::size_t number, const ModuleFit& module) {
  Json json{{"module", number},
            {"map", module.is_grid ? "grid" : "pinhole"},
            {"observations", module.observations},
            {"outliers", module.outliers},
            {"noise_px", module.noise_px},
            {"before", summary_json(module.before)},
            {"after", summary_json(module.after)}};
  if (module.held_out_pinhole_px) {
    json["held_out"] = {{"pinhole_px", *module.held_out_pinhole_px}, {"field_px", *module.held_out_field_px}};
  }
  json["held_by_start"] = module.held_by_start;
  return json;
}

// "position x in 4 modules, ...": the parameters about which observations say little.
std::string held_text(const std::vector<ModuleFit>& modules) {
  std::map<std::string, int> counts;
  for (const ModuleFit& module : modules) {
    for (const std::string& parameter : module.held_by_start) ++counts[parameter];
  }
  std::string text;
  for (const auto& [parameter, count] : counts) {
    text += fmt::format("{}{} in {} module{}", text.empty() ? "" : ", ", parameter, count, count == 1 ? "" : "s");
  }
  return text;
}

std::string summary_text(const ResidualSummary& summary) {
  return fmt::format("{:>9.3g} {:>9.3g} {:>9.3g}", summary.median_px, summary.quantile_99_px, summary.max_px);
}

}  // namespace

std::string fit_json(const FittedDisplay& fitted, const Observations& observations) {
  Json json{{"version", kVersion},
            {"observations", {{"file", observations.source}, {"count", observations.points.size()}}},
            {"screen_radius_m", fitted.display.optics.screen_radius_m},
            {"screen_radius_sd_m", fitted.radius_sd_m},
            {"screen_radius_is_held", fitted.radius_is_held},
            {"modules", Json::array()},
            {"outliers", Json::array()}};
  for (std::size_t k = 0; k < fitted.modules.size(); ++k) json["modules"].push_back(module_json(k, fitted.modules[k]));
  for (const Outlier& outlier : fitted.outliers) {
    json["outliers"].push_back(
        {{"module", outlier.module}, {"line", outlier.line}, {"residual_px", outlier.residual_px}});
  }
  return json.dump(2) + "\n";
}

std::string fit_table(const FittedDisplay& fitted, const Observations& observations) {
  std::string text = fmt::format("{:<7}{:>7}{:>9}  {:<8} {:^29} {:^29}\n", "", "", "", "", "residuals before, px",
                                 "after, without outliers, px");
  text += fmt::format("{:<7}{:>7}{:>9}  {:<8} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "module", "points", "outliers",
                      "map", "median", "99 %", "max", "median", "99 %", "max");
  const auto out = std::back_inserter(text);
  for (std::size_t k = 0; k < fitted.modules.size(); ++k) {
    const ModuleFit& module = fitted.modules[k];
    fmt::format_to(out, "{:<7}{:>7}{:>9}  {:<8} {} {}\n", k, module.observations, module.outliers,
                   module.is_grid ? "grid" : "pinhole", summary_text(module.before), summary_text(module.after));
  }
  if (const double radius = fitted.display.optics.screen_radius_m; radius != 0) {
    fmt::format_to(out, "screen radius: {:.6g} m, {}\n", radius,
                   fitted.radius_is_held ? "the start's: warps that no pinhole has hide it"
                                         : fmt::format("standard deviation {:.2g} m", fitted.radius_sd_m));
  }
  if (const std::string held = held_text(fitted.modules); !held.empty()) {
    fmt::format_to(out, "held by the start more than by the observations: {}\n", held);
  }
  for (const Outlier& outlier : fitted.outliers) {
    fmt::format_to(out, "outlier: {}:{}: module {}: {:.3g} px\n", observations.source, outlier.line, outlier.module,
                   outlier.residual_px);
  }
  return text;
}

}  // namespace lfd
