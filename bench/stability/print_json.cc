// The table for programs.
#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/stability/suite.h"

namespace lfd::bench {

std::string json_of(const StabilityTable& table) {
  nlohmann::ordered_json json;
  json["version"] = table.version;
  json["renderer"] = table.renderer;
  json["missed"] = table.missed();
  json["cases"] = nlohmann::ordered_json::array();
  for (const StabilityRow& row : table.rows) {
    nlohmann::ordered_json one;
    one["group"] = row.group;
    one["case"] = row.name;
    one["expected"] = row.expected;
    one["got"] = row.outcome.got;
    // JSON has no infinity.
    one["worst_error"] = std::isfinite(row.outcome.worst) ? nlohmann::ordered_json(row.outcome.worst) : nullptr;
    one["passed"] = row.outcome.passed;
    json["cases"].push_back(one);
  }
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace lfd::bench
