// The table for people, in Markdown.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "base/log.h"
#include "bench/ao/ao_bench.h"
#include "bench/ao/print_text.h"

namespace lfd::bench {
namespace {

std::string percent(double share) { return fmt::format("{:.1f} %", 100 * share); }

std::string subject_text(const AoTable& table) {
  const AoRow& first = table.rows.front();
  const std::size_t frames = std::ranges::max(table.rows, {}, &AoRow::frames).frames;
  std::string text =
      fmt::format("# Ambient occlusion: error against run time\n\n{}. lfd {}.\n", table.renderer, table.version);
  text += fmt::format(
      "Display {}, images of {}x{} px; reference: {} rays a pixel, cosine-weighted, linear falloff. Errors are of "
      "openness (1 - ao) after\n"
      "blur and curve, over pixels with a surface; *fitted*: the curve's a, b, c fitted on the other scenes at the "
      "same radius. Times are GPU\n"
      "timer queries around the passes, of one module, the median of up to {} frames; *x*: over `sphere` as it comes, "
      "drawn "
      "in the same round.\n"
      "*Inconsistent*: share of surface points that the next module shows with an occlusion more than 0.02 away.\n",
      first.display, first.image.width, first.image.height, table.rays, frames);
  return text;
}

std::string places_text(const AoTable& table) {
  std::string text =
      "\n## Places\n\n| scene | module | place | R, % of the diagonal | R, m | R, px | MAE without occlusion |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const AoPlaceFacts& place : table.places) {
    text +=
        fmt::format("| {} | {} | {} | {:g} | {:.4g} | {:.1f} | {:.4f} |\n", place.scene, place.module,
                    name_of(place.place), 100 * place.radius_share, place.radius_m, place.radius_px, place.mae_of_none);
  }
  return text;
}

constexpr const char* kRowTitles =
    "| method | settings | blur | samples | ms | blur ms | x | MAE | SSIM | fitted MAE | fitted SSIM | inconsistent, "
    "fitted |\n"
    "|---|---|---|---|---|---|---|---|---|---|---|---|\n";

std::string row_text(const AoRow& r) {
  return fmt::format("| {} | {} | {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.4f} | {:.4f} | {:.4f} | {:.4f} | {} |\n",
                     r.rung.method(), r.rung.name, r.blur, r.taps.samples, r.occlusion_ms.median, r.blur_ms.median,
                     r.ratio.median, r.judged.mae, r.judged.ssim, fitted_or_not(r).mae, fitted_or_not(r).ssim,
                     percent(fitted_or_not(r).inconsistent));
}

// Rows of the middle module at the middle radius of a scene, the fastest first.
std::vector<AoRow> study_rows(const AoTable& table, const std::string& scene) {
  std::vector<AoRow> rows;
  std::ranges::copy_if(table.rows, std::back_inserter(rows), [&](const AoRow& r) {
    return r.scene == scene && r.is_middle() && r.radius_share == table.middle_radius();
  });
  std::ranges::sort(rows, {}, &AoRow::total_ms);
  return rows;
}

std::string fronts_text(const AoTable& table) {
  std::string text;
  for (const std::string& scene : table.scenes()) {
    text += fmt::format(
        "\n## {}: what nothing is both faster and better than\n\nMiddle module, middle radius, time of blur "
        "counted.\n\n{}",
        scene, kRowTitles);
    double best = 2;
    for (const AoRow& row : study_rows(table, scene)) {
      if (row.rung.is_default || fitted_or_not(row).mae >= best) continue;
      best = fitted_or_not(row).mae;
      text += row_text(row);
    }
  }
  return text;
}

// Means over the middle modules of all scenes at the middle radius.
struct Mean {
  double ms = 0, blur_ms = 0, ratio = 0, mae = 0, fitted = 0, silhouette = 0, inconsistent = 0;
  int scenes = 0;
};

Mean mean_of(const AoTable& table, const std::function<bool(const AoRow&)>& is_meant) {
  Mean mean;
  for (const std::string& scene : table.scenes()) {
    for (const AoRow& row : study_rows(table, scene)) {
      if (!is_meant(row)) continue;
      mean.ms += row.occlusion_ms.median;
      mean.blur_ms += row.blur_ms.median;
      mean.ratio += row.ratio.median;
      mean.mae += row.judged.mae;
      mean.fitted += fitted_or_not(row).mae;
      mean.silhouette += fitted_or_not(row).mae_silhouette;
      mean.inconsistent += fitted_or_not(row).inconsistent;
      ++mean.scenes;
    }
  }
  for (double* sum :
       {&mean.ms, &mean.blur_ms, &mean.ratio, &mean.mae, &mean.fitted, &mean.silhouette, &mean.inconsistent})
    *sum /= std::max(1, mean.scenes);
  return mean;
}

std::vector<std::string> methods_of(const AoTable& table) {
  std::vector<std::string> methods;
  for (const AoRow& row : table.rows) {
    if (std::ranges::find(methods, row.rung.method()) == methods.end()) methods.push_back(row.rung.method());
  }
  return methods;
}

std::vector<std::string> default_names_of(const AoTable& table, const std::string& method) {
  std::vector<std::string> names;
  for (const AoRow& row : table.rows) {
    if (row.rung.method() == method && row.rung.name.starts_with("default") &&
        std::ranges::find(names, row.rung.name) == names.end())
      names.push_back(row.rung.name);
  }
  std::ranges::sort(names);
  return names;
}

std::string options_text(const AoTable& table) {
  std::string text =
      "\n## Blurs and options alone\n\nMeans over the scenes, middle module, middle radius; every method as it comes "
      "but "
      "for what is named. *Added*: fitted MAE less that of the same\nmethod without blur: what the blur adds, or "
      "removes "
      "where it is below 0.\n\n"
      "| method | what | x | blur ms | MAE | fitted MAE | added | near silhouettes | inconsistent, fitted "
      "|\n|---|---|---|---|---|---|---|---|---|\n";
  for (const std::string& method : methods_of(table)) {
    const auto mean_of_name = [&](const std::string& name) {
      return mean_of(table, [&](const AoRow& r) { return r.rung.method() == method && r.rung.name == name; });
    };
    const double unblurred = mean_of_name("default, no blur").fitted;
    for (const std::string& name : default_names_of(table, method)) {
      const Mean mean = mean_of_name(name);
      text += fmt::format("| {} | {} | {:.2f} | {:.2f} | {:.4f} | {:.4f} | {:+.4f} | {:.4f} | {} |\n", method, name,
                          mean.ratio, mean.blur_ms, mean.mae, mean.fitted, mean.fitted - unblurred, mean.silhouette,
                          percent(mean.inconsistent));
    }
  }
  return text;
}

// How a number grows when another doubles, from the first to the last: 1 as fast, 0 not at all.
double exponent(double from, double to, double x_from, double x_to) {
  return std::log(to / from) / std::log(x_to / x_from);
}

double pixels_of(const ScalingRow& row) { return static_cast<double>(row.image.width) * row.image.height; }

using RowsOfMethod = std::map<std::string, std::vector<ScalingRow>>;

double time_exponent(const std::vector<ScalingRow>& rows, const std::function<double(const ScalingRow&)>& x_of) {
  return exponent(rows.front().occlusion_ms, rows.back().occlusion_ms, x_of(rows.front()), x_of(rows.back()));
}

// Which grow, and how.
std::string growth_sentence(const RowsOfMethod& of_method, const char* what,
                            const std::function<double(const ScalingRow&)>& x_of) {
  constexpr double kGrows = 0.15, kWorse = 1.25;
  std::vector<std::string> slower, worse;
  for (const auto& [method, rows] : of_method) {
    if (time_exponent(rows, x_of) > kGrows)
      slower.push_back(fmt::format("{} ({:.2f})", method, time_exponent(rows, x_of)));
    if (rows.back().mae > kWorse * rows.front().mae)
      worse.push_back(fmt::format("{} ({:.1f} x)", method, rows.back().mae / rows.front().mae));
  }
  const auto list = [](const std::vector<std::string>& names) {
    return names.empty() ? std::string("of none") : fmt::format("of {}", fmt::join(names, ", "));
  };
  return fmt::format("With {} the time grows {}: the power of each in brackets. The error grows {}.\n", what,
                     list(slower), list(worse));
}

std::string scaling_text(const std::vector<ScalingRow>& rows, const char* title, const char* what,
                         const std::function<double(const ScalingRow&)>& x_of,
                         const std::function<std::string(const ScalingRow&)>& label) {
  RowsOfMethod of_method;
  for (const ScalingRow& row : rows) of_method[row.method].push_back(row);
  if (of_method.empty()) return "";
  std::string text = fmt::format(
      "\n## {}\n\nThe first scene, middle module, every method as it comes, unfitted: ms, MAE.\n\n| method |", title);
  const auto& first = of_method.begin()->second;
  for (const ScalingRow& row : first) text += fmt::format(" {} |", label(row));
  text += fmt::format(" time grows with {} to the power of | MAE, last over first |\n|---|", what);
  for (std::size_t i = 0; i < first.size() + 2; ++i) text += "---|";
  for (const auto& [method, of] : of_method) {
    text += fmt::format("\n| {} |", method);
    for (const ScalingRow& row : of) text += fmt::format(" {:.1f}, {:.4f} |", row.occlusion_ms, row.mae);
    text += fmt::format(" {:.2f} | {:.2f} |", time_exponent(of, x_of), of.back().mae / of.front().mae);
  }
  return text + "\n\n" + growth_sentence(of_method, what, x_of);
}

std::string front_table(const AoTable& table) {
  std::string text =
      "\n## The front that nodes choose from\n\nMeans over all scenes, modules and radii, each with its own blur.\n\n| "
      "settings "
      "| x | fitted MAE |\n|---|---|---|\n";
  const proto::OcclusionFront front = front_of(table);
  for (const auto& entry : front.entry())
    text += fmt::format("| {} | {:.2f} | {:.4f} |\n", entry.name(), entry.ratio(), entry.mae());
  return text;
}

}  // namespace

std::string text_of(const AoTable& table) {
  if (table.rows.empty()) return "no rows\n";
  const auto by_radius = [](const ScalingRow& row) {
    return fmt::format("R {:g} % ({:.0f} px)", 100 * row.radius_share, row.radius_px);
  };
  const auto by_size = [](const ScalingRow& row) { return fmt::format("{}x{}", row.image.width, row.image.height); };
  return subject_text(table) + places_text(table) + front_table(table) + fronts_text(table) + options_text(table) +
         sharing_text(table) +
         scaling_text(
             table.by_radius, "Growing radius", "the radius", [](const ScalingRow& row) { return row.radius_share; },
             by_radius) +
         scaling_text(table.by_size, "Growing resolution", "the pixels", pixels_of, by_size);
}

}  // namespace lfd::bench
