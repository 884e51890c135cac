// The table for people.
#include <algorithm>

#include "base/log.h"
#include "bench/frame/print.h"

namespace lfd::bench {
namespace {

std::string cells(const std::optional<Spread>& spread) {
  if (!spread) return fmt::format("{:>8} {:>8} {:>15}", "-", "-", "-");
  return fmt::format("{:>8.3f} {:>8.3f} {:>15}", spread->mean, spread->median,
                     fmt::format("{:.2f}..{:.2f}", spread->percent_5, spread->percent_95));
}

std::string line_of(const PassRow& row) {
  return fmt::format("{:<16} {}   {}   {:>8.3f} {:>8.3f}\n", row.pass, cells(row.without_ao), cells(row.with_ao),
                     row.difference_of_means(), row.difference_of_medians());
}

std::string subject_text(const FrameSubject& s, int frames) {
  std::string text =
      fmt::format("scene      {}: {} faces, {} textures; {} triangles drawn\n", s.scene, s.faces, s.textures,
                  s.drawn_triangles) +
      fmt::format("display    {}, module {} of {}, {}x{} px\n", s.display, s.module, s.modules, s.image.width,
                  s.image.height) +
      fmt::format("occlusion  R {:.6g} m in the world ({:.3g} of the ROI diagonal), {} samples, {} radii, blur {}\n",
                  s.ao_radius_m, s.ao_radius_m / s.roi_diagonal_m, s.ao.samples, s.ao.radii, blur_text(s.ao));
  text += fmt::format("renderer   {}\n", s.renderer);
  text += fmt::format("program    {}, commit {}; geometry built once in {:.0f} ms\n", s.version, s.commit,
                      s.geometry_build_ms);
  return text +
         fmt::format("times      ms, GPU timer queries, {} frames of each kind in turn, nothing read back\n", frames);
}

std::string times_text(const PassTimes& times) {
  std::string text = fmt::format("{:<16} {:<33}   {:<33}   {}\n", "", "without occlusion", "with", "difference of");
  const auto titles = fmt::format("{:>8} {:>8} {:>15}", "mean", "median", "5..95 %");
  text += fmt::format("{:<16} {}   {}   {:>8} {:>8}\n", "pass", titles, titles, "means", "medians");
  for (const PassRow& row : times.pass) text += line_of(row);
  return text + line_of(times.sum) + line_of(times.wall);
}

std::string left_out_text(const char* title, const std::vector<std::string>& left_out) {
  std::string text;
  for (const std::string& line : left_out) text += fmt::format("left out {}: {}\n", title, line);
  return text;
}

std::string error_text(const FrameError& error) {
  const reference::Truth& p = error.position;
  std::string text =
      fmt::format("positions  error / ROI diagonal: median {:.2e}, 99 % {:.2e}, max {:.2e}; {} pixels compared\n",
                  p.median, p.percent_99, p.max, p.compared) +
      fmt::format("surface    in only one of picture and reference: {:.4f} % of {} pixels\n", 100 * p.mismatch_share,
                  p.in_both + p.only_in_reference + p.only_in_rendered);
  for (const std::string& broken : reference::broken_bounds(p)) text += "out of bounds: " + broken + "\n";
  return text + fmt::format(
                    "occlusion  MAE against the method's own limit {:.4f} +- {:.4f}, mean {:+.4f}; {} random pixels"
                    " (seed {}), {} samples each\n",
                    error.ao.mean_absolute, error.ao.standard_error, error.ao.mean_signed, error.ao.pixels,
                    error.ao.subset.seed, error.ao.subset.samples);
}

}  // namespace

std::string text_of(const FrameTable& table) {
  return subject_text(table.subject, table.times.frames) + "\n" + times_text(table.times) + "\n" +
         left_out_text("without occlusion", table.times.left_out_without_ao) +
         left_out_text("with", table.times.left_out_with_ao) + error_text(table.error);
}

}  // namespace lfd::bench
