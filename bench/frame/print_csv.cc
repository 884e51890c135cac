// The table for spreadsheets.
#include "base/log.h"
#include "bench/common/csv.h"
#include "bench/frame/print.h"

namespace lfd::bench {
namespace {

constexpr const char* kTitles =
    "scene,faces,textures,triangles,display,module,width_px,height_px,ao_radius_m,ao_samples,ao_radii,frames,renderer,"
    "commit,pass,without_mean_ms,without_median_ms,without_5_percent_ms,without_95_percent_ms,with_mean_ms,"
    "with_median_ms,with_5_percent_ms,with_95_percent_ms,difference_of_means_ms,position_median,position_99_percent,"
    "position_max,mismatch_share,ao_mae,ao_mae_standard_error,ao_pixels,ao_reference_samples\n";

std::string subject_cells(const FrameSubject& s, int frames) {
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{}", csv_cell(s.scene), s.faces, s.textures,
                     s.drawn_triangles, csv_cell(s.display), s.module, s.image.width, s.image.height, s.ao_radius_m,
                     s.ao.samples, s.ao.radii, frames, csv_cell(s.renderer), csv_cell(s.commit));
}

std::string spread_cells(const std::optional<Spread>& spread) {
  if (!spread) return ",,,";
  return fmt::format("{:.6f},{:.6f},{:.6f},{:.6f}", spread->mean, spread->median, spread->percent_5,
                     spread->percent_95);
}

std::string row_cells(const PassRow& row) {
  return fmt::format("{},{},{},{:.6f}", row.pass, spread_cells(row.without_ao), spread_cells(row.with_ao),
                     row.difference_of_means());
}

std::string error_cells(const FrameError& error) {
  const reference::Truth& p = error.position;
  return fmt::format("{:.6e},{:.6e},{:.6e},{:.6e},{:.6f},{:.6f},{},{}", p.median, p.percent_99, p.max, p.mismatch_share,
                     error.ao.mean_absolute, error.ao.standard_error, error.ao.pixels, error.ao.subset.samples);
}

}  // namespace

std::string csv_of(const FrameTable& table) {
  const std::string subject = subject_cells(table.subject, table.times.frames);
  constexpr const char* kNoErrors = ",,,,,,,";
  std::string csv = kTitles;
  for (const PassRow& row : table.times.pass) csv += fmt::format("{},{},{}\n", subject, row_cells(row), kNoErrors);
  csv += fmt::format("{},{},{}\n", subject, row_cells(table.times.sum), error_cells(table.error));
  return csv + fmt::format("{},{},{}\n", subject, row_cells(table.times.wall), kNoErrors);
}

}  // namespace lfd::bench
