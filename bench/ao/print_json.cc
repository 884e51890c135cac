// The table for programs.
#include <nlohmann/json.hpp>

#include "bench/ao/ao_bench.h"

namespace lfd::bench {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Spread& spread) {
  return {{"median", spread.median}, {"percent_5", spread.percent_5}, {"percent_95", spread.percent_95}};
}

Json json_of(const AoJudgement& j) {
  return {{"mae", j.mae},
          {"ssim", j.ssim},
          {"bias", j.bias},
          {"mae_uniform", j.mae_uniform},
          {"mae_silhouette", j.mae_silhouette},
          {"inconsistent", j.inconsistent}};
}

Json json_of(const occlusion::Curve& curve) { return {curve.a, curve.b, curve.c}; }

Json json_of(const AoRow& r) {
  Json row{{"scene", r.scene},
           {"display", r.display},
           {"module", r.module},
           {"place", name_of(r.place)},
           {"image_px", {r.image.width, r.image.height}},
           {"radius_share", r.radius_share},
           {"radius_m", r.radius_m},
           {"radius_px", r.radius_px},
           {"method", r.rung.method()},
           {"settings", r.rung.name},
           {"origin", r.rung.origin},
           {"blur", r.blur},
           {"samples", r.taps.samples},
           {"fetches", r.taps.fetches},
           {"layers", r.layers},
           {"frames", r.frames},
           {"ao_ms", json_of(r.occlusion_ms)},
           {"blur_ms", json_of(r.blur_ms)},
           {"ratio", json_of(r.ratio)},
           {"curve", json_of(r.curve)},
           {"unfitted", json_of(r.judged)},
           {"pixels", r.pixels},
           {"shared_points", r.shared_points}};
  row["fitted"] = r.fitted ? Json{{"curve", json_of(r.fitted->curve)}, {"errors", json_of(r.fitted->judged)}} : Json();
  return row;
}

Json json_of(const ScalingRow& r) {
  return {{"method", r.method},
          {"radius_share", r.radius_share},
          {"radius_px", r.radius_px},
          {"image_px", {r.image.width, r.image.height}},
          {"ao_ms", r.occlusion_ms},
          {"ratio", r.ratio},
          {"mae", r.mae}};
}

Json json_of(const AoPlaceFacts& p) {
  return {{"scene", p.scene},
          {"display", p.display},
          {"place", name_of(p.place)},
          {"radius_m", p.radius_m},
          {"radius_px", p.radius_px},
          {"module", p.module},
          {"radius_share", p.radius_share},
          {"mae_of_none", p.mae_of_none},
          {"cast_ms", p.cast_ms}};
}

Json json_of(const SharingRow& r) {
  return {{"modules", r.modules}, {"alone_ms", r.alone_ms}, {"shared_ms", r.shared_ms}};
}

template <class Row>
Json list_of(const std::vector<Row>& rows) {
  Json list = Json::array();
  for (const Row& row : rows) list.push_back(json_of(row));
  return list;
}

}  // namespace

std::string json_of(const AoTable& table) {
  const Json all{
      {"renderer", table.renderer},        {"version", table.version},         {"rays", table.rays},
      {"places", list_of(table.places)},   {"rows", list_of(table.rows)},      {"by_radius", list_of(table.by_radius)},
      {"by_size", list_of(table.by_size)}, {"sharing", list_of(table.sharing)}};
  return all.dump(1) + "\n";
}

}  // namespace lfd::bench
