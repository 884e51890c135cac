// Observations by module, as the plot wants them.
#include "cli/fit_plots.h"

#include <set>

#include "base/file.h"
#include "base/log.h"
#include "cli/plots/residual_plot.h"

namespace lfd {

Status write_fit_plots(const std::filesystem::path& folder, const FittedDisplay& fitted,
                       const Observations& observations) {
  std::set<std::size_t> outlier_lines;
  for (const Outlier& outlier : fitted.outliers) outlier_lines.insert(outlier.line);
  std::vector<std::vector<plots::SeenPoint>> modules(fitted.modules.size());
  for (const Observation& seen : observations.points) {
    modules[static_cast<std::size_t>(seen.module)].push_back(
        {seen.in_image, seen.on_screen, outlier_lines.contains(seen.line)});
  }
  LFD_TRY_STATUS(make_folder(folder));
  for (std::size_t k = 0; k < modules.size(); ++k) {
    const auto file = folder / fmt::format("residuals-module-{:03}.svg", k);
    LFD_TRY_STATUS(write_file(file, plots::residuals(fitted.display, static_cast<int>(k), modules[k])));
  }
  return {};
}

}  // namespace lfd
