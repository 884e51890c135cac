// A check's report for programs.
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/version.h"
#include "cli/lfd_calibrate_check.h"

namespace lfd {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

// Of a field of MapNumbers.
struct Field {
  const char* name;
  double MapNumbers::*value;
};
constexpr Field kFields[] = {{"round_trip_median_px", &MapNumbers::round_trip_median_px},
                             {"round_trip_999_px", &MapNumbers::round_trip_999_px},
                             {"round_trip_max_px", &MapNumbers::round_trip_max_px},
                             {"image_on_screen", &MapNumbers::image_on_screen},
                             {"image_unmapped", &MapNumbers::image_unmapped},
                             {"mirrored", &MapNumbers::mirrored},
                             {"near_singular", &MapNumbers::near_singular},
                             {"folded", &MapNumbers::folded},
                             {"incomplete", &MapNumbers::incomplete},
                             {"condition_median", &MapNumbers::condition_median},
                             {"condition_99", &MapNumbers::condition_99},
                             {"condition_max", &MapNumbers::condition_max},
                             {"coverage", &MapNumbers::coverage}};

Json numbers_json(const MapNumbers& numbers) {
  Json json;
  for (const Field& field : kFields) json[field.name] = number(numbers.*field.value);
  return json;
}

// Which module is worst by each field; for what is better when it is large, the least.
Json worst_json(const CalibrationReport& report) {
  Json json;
  for (const Field& field : kFields) {
    const bool is_share_lit = field.value == &MapNumbers::coverage;
    if (field.value == &MapNumbers::image_on_screen) continue;
    json[field.name] = is_share_lit ? report.least_covering() : report.worst_by(field.value);
  }
  return json;
}

Json spacing_json(const std::optional<AngularSpacing>& spacing) {
  if (!spacing) return nullptr;
  return {{"min_rad", spacing->min_rad}, {"median_rad", spacing->median_rad}, {"max_rad", spacing->max_rad}};
}

Json angles_json(const AngularReport& angles) {
  constexpr const char* kOrders[] = {"left_to_right", "right_to_left", "mixed"};
  Json json{{"from_centre", spacing_json(angles.from_centre)},
            {"from_left", spacing_json(angles.from_left)},
            {"from_right", spacing_json(angles.from_right)},
            {"order", kOrders[static_cast<int>(angles.order)]},
            {"gaps", Json::array()},
            {"scattering_rad", angles.scattering_rad},
            {"scattering_over_rule", angles.scattering_over_rule ? number(*angles.scattering_over_rule) : Json()},
            {"gap_over_scattering", angles.gap_over_scattering ? number(*angles.gap_over_scattering) : Json()}};
  for (const AngularGap& gap : angles.gaps) {
    json["gaps"].push_back({{"modules", {gap.left_module, gap.right_module}}, {"angle_rad", gap.angle_rad}});
  }
  return json;
}

Json depth_json(const std::optional<DepthBudget>& depth) {
  if (!depth) return nullptr;
  Json json{{"spot_on_screen_m", depth->spot_on_screen_m},
            {"angular_resolution_rad", depth->angular_resolution_rad},
            {"doubled_at_m", number(depth->doubled_at_m)},
            {"spots", Json::array()}};
  for (const DepthBudget::Spot& spot : depth->spots) {
    json["spots"].push_back({{"distance_m", spot.distance_m}, {"spot_m", spot.spot_m}});
  }
  return json;
}

Json roi_json(const std::optional<PhysicalBox>& roi) {
  if (!roi) return nullptr;
  return {{"physical_centre", {roi->centre.x, roi->centre.y, roi->centre.z}},
          {"physical_size", {roi->size.x, roi->size.y, roi->size.z}}};
}

Json limits_json(const AcceptanceLimits& limits) {
  return {{"round_trip_max_px", number(limits.round_trip_max_px)},
          {"mirrored", number(limits.mirrored)},
          {"near_singular", number(limits.near_singular)},
          {"folded", number(limits.folded)},
          {"image_unmapped", number(limits.image_unmapped)},
          {"condition_max", number(limits.condition_max)},
          {"coverage_least", number(limits.coverage_least)},
          {"incomplete", number(limits.incomplete)},
          {"gap_over_scattering", number(limits.gap_over_scattering)},
          {"depth_least_m", number(limits.depth_least_m)}};
}

}  // namespace

std::string check_json(const DisplayCalibration& display, const CalibrationReport& report,
                       const AcceptanceLimits& limits) {
  const std::vector<std::string> missed = missed_limits(report, limits);
  Json json{{"version", kVersion},
            {"display", display.name},
            {"accepted", missed.empty()},
            {"missed", missed},
            {"limits", limits_json(limits)},
            {"half_depth_m", report.sampling.roi ? Json() : Json(report.half_depth_m)},
            {"roi", roi_json(report.sampling.roi)},
            {"all", numbers_json(report.all)},
            {"worst_module", worst_json(report)},
            {"coverage_any", report.coverage_any},
            {"pixel_width_m", report.pixel_width_m},
            {"angles", angles_json(report.angles)},
            {"depth", depth_json(report.depth)},
            {"modules", Json::array()}};
  for (const MapNumbers& module : report.modules) json["modules"].push_back(numbers_json(module));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lfd
