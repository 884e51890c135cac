// The table for programs.
#include <nlohmann/json.hpp>

#include "bench/frame/print.h"

namespace lfd::bench {
namespace {

using Json = nlohmann::ordered_json;

Json subject_json(const FrameSubject& s) {
  Json parameters = Json::object();
  for (std::size_t i = 0; i < s.ao.parameters.size(); ++i)
    parameters[std::string(s.ao.method->parameters[i].name)] = s.ao.parameters[i];
  return {{"scene", s.scene},
          {"faces", s.faces},
          {"textures", s.textures},
          {"drawn_triangles", s.drawn_triangles},
          {"display", s.display},
          {"module", s.module},
          {"modules", s.modules},
          {"image_px", {s.image.width, s.image.height}},
          {"roi_diagonal_m", s.roi_diagonal_m},
          {"ao",
           {{"radius_m", s.ao_radius_m},
            {"samples", s.ao.samples},
            {"radii", s.ao.radii},
            {"method", s.ao.method->name},
            {"parameters", parameters},
            {"seed", s.ao.seed},
            {"curve", {s.ao.curve.a, s.ao.curve.b, s.ao.curve.c}},
            {"blur", blur_text(s.ao)}}},
          {"renderer", s.renderer},
          {"version", s.version},
          {"commit", s.commit},
          {"geometry_build_ms", s.geometry_build_ms}};
}

Json spread_json(const std::optional<Spread>& spread) {
  if (!spread) return nullptr;
  return {{"mean", spread->mean},
          {"median", spread->median},
          {"percent_5", spread->percent_5},
          {"percent_95", spread->percent_95}};
}

Json row_json(const PassRow& row) {
  return {{"pass", row.pass},
          {"without_ao_ms", spread_json(row.without_ao)},
          {"with_ao_ms", spread_json(row.with_ao)},
          {"difference_of_means_ms", row.difference_of_means()},
          {"difference_of_medians_ms", row.difference_of_medians()}};
}

Json times_json(const PassTimes& times) {
  Json passes = Json::array();
  for (const PassRow& row : times.pass) passes.push_back(row_json(row));
  return {{"frames", times.frames},
          {"passes", passes},
          {"sum", row_json(times.sum)},
          {"wall_clock", row_json(times.wall)},
          {"left_out_without_ao", times.left_out_without_ao},
          {"left_out_with_ao", times.left_out_with_ao}};
}

Json error_json(const FrameError& error) {
  const reference::Truth& p = error.position;
  return {{"position_over_roi_diagonal",
           {{"median", p.median},
            {"percent_99", p.percent_99},
            {"max", p.max},
            {"worst_pixel", {p.worst.column, p.worst.row}},
            {"compared_pixels", p.compared},
            {"near_silhouette_pixels", p.near_silhouette},
            {"mismatch_share", p.mismatch_share},
            {"broken_bounds", reference::broken_bounds(p)}}},
          {"ao_against_own_limit",
           {{"mae", error.ao.mean_absolute},
            {"mae_standard_error", error.ao.standard_error},
            {"mean", error.ao.mean_signed},
            {"pixels", error.ao.pixels},
            {"samples", error.ao.subset.samples},
            {"seed", error.ao.subset.seed}}}};
}

}  // namespace

std::string json_of(const FrameTable& table) {
  const Json json{
      {"subject", subject_json(table.subject)}, {"times", times_json(table.times)}, {"error", error_json(table.error)}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lfd::bench
