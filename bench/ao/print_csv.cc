// All rows for spreadsheets.
#include <algorithm>
#include <array>
#include <map>

#include "base/check.h"
#include "base/log.h"
#include "bench/ao/ao_bench.h"
#include "bench/common/csv.h"

namespace lfd::bench {
namespace {

constexpr std::array kTitles{"scene",
                             "display",
                             "module",
                             "place",
                             "width_px",
                             "height_px",
                             "radius_share",
                             "radius_m",
                             "radius_px",
                             "method",
                             "settings",
                             "origin",
                             "blur",
                             "samples",
                             "fetches",
                             "layers",
                             "frames",
                             "ao_ms",
                             "ao_ms_5",
                             "ao_ms_95",
                             "blur_ms",
                             "ratio",
                             "ratio_5",
                             "ratio_95",
                             "mae",
                             "ssim",
                             "bias",
                             "mae_uniform",
                             "mae_silhouette",
                             "inconsistent",
                             "fit_a",
                             "fit_b",
                             "fit_c",
                             "fitted_mae",
                             "fitted_ssim",
                             "fitted_bias",
                             "fitted_mae_uniform",
                             "fitted_mae_silhouette",
                             "fitted_inconsistent",
                             "pixels",
                             "shared_points",
                             "mae_of_none",
                             "renderer",
                             "version"};

// Cells by their titles; what is not said is empty.
class Line {
 public:
  template <class Value>
  Line& set(const char* title, const Value& value) {
    LFD_CHECK(std::ranges::find(kTitles, std::string_view(title)) != kTitles.end(), title);
    if constexpr (std::is_floating_point_v<Value>) {
      cells_[title] = fmt::format("{:.6g}", value);
    } else if constexpr (std::is_integral_v<Value>) {
      cells_[title] = fmt::to_string(value);
    } else {
      cells_[title] = csv_cell(value);
    }
    return *this;
  }

  Line& set_judged(const std::string& prefix, const AoJudgement& j) {
    set((prefix + "mae").c_str(), j.mae).set((prefix + "ssim").c_str(), j.ssim).set((prefix + "bias").c_str(), j.bias);
    set((prefix + "mae_uniform").c_str(), j.mae_uniform).set((prefix + "mae_silhouette").c_str(), j.mae_silhouette);
    return set((prefix + "inconsistent").c_str(), j.inconsistent);
  }

  std::string text() const {
    std::vector<std::string> cells;
    for (const char* title : kTitles) {
      const auto cell = cells_.find(title);
      cells.push_back(cell == cells_.end() ? std::string() : cell->second);
    }
    return fmt::format("{}\n", fmt::join(cells, ","));
  }

 private:
  std::map<std::string, std::string, std::less<>> cells_;
};

Line line_of(const AoPlaceFacts& place) {
  Line line;
  line.set("scene", place.scene).set("display", place.display).set("module", place.module);
  line.set("place", name_of(place.place)).set("width_px", place.image.width).set("height_px", place.image.height);
  line.set("radius_share", place.radius_share).set("radius_m", place.radius_m).set("radius_px", place.radius_px);
  return line.set("mae_of_none", place.mae_of_none);
}

// The reference itself: its time is that of the CPU, for all radii together.
std::string line_of_rays(const AoPlaceFacts& place, const AoTable& table) {
  Line line = line_of(place);
  line.set("method", "raytraced").set("settings", fmt::format("{} rays", table.rays)).set("samples", table.rays);
  line.set("blur", "none").set("ao_ms", place.cast_ms).set("mae", 0).set("ssim", 1).set("bias", 0);
  return line.set("renderer", "CPU").set("version", table.version).text();
}

std::string line_of(const AoPlaceFacts& place, const AoRow& r, const AoTable& table) {
  Line line = line_of(place);
  line.set("method", r.rung.method()).set("settings", r.rung.name).set("origin", r.rung.origin).set("blur", r.blur);
  line.set("samples", r.taps.samples).set("fetches", r.taps.fetches).set("layers", r.layers).set("frames", r.frames);
  line.set("ao_ms", r.occlusion_ms.median).set("ao_ms_5", r.occlusion_ms.percent_5);
  line.set("ao_ms_95", r.occlusion_ms.percent_95).set("blur_ms", r.blur_ms.median);
  line.set("ratio", r.ratio.median).set("ratio_5", r.ratio.percent_5).set("ratio_95", r.ratio.percent_95);
  line.set_judged("", r.judged);
  if (r.fitted) {
    line.set("fit_a", r.fitted->curve.a).set("fit_b", r.fitted->curve.b).set("fit_c", r.fitted->curve.c);
    line.set_judged("fitted_", r.fitted->judged);
  }
  line.set("pixels", r.pixels).set("shared_points", r.shared_points);
  return line.set("renderer", table.renderer).set("version", table.version).text();
}

}  // namespace

std::string csv_of(const AoTable& table) {
  std::string text = fmt::format("{}\n", fmt::join(kTitles, ","));
  for (const AoPlaceFacts& place : table.places) {
    text += line_of_rays(place, table);
    for (const AoRow& row : table.rows) {
      if (row.scene == place.scene && row.module == place.module && row.radius_share == place.radius_share)
        text += line_of(place, row, table);
    }
  }
  return text;
}

}  // namespace lfd::bench
