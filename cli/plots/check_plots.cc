// Which pictures a check writes, and of which module.
#include "cli/plots/check_plots.h"

#include <tuple>

#include "base/file.h"
#include "base/log.h"

namespace lfd {

int worst_module(const CalibrationReport& report) {
  const auto badness = [&](int k) {
    const MapNumbers& m = report.modules[static_cast<std::size_t>(k)];
    return std::tuple(m.folded + m.mirrored, -m.coverage, m.condition_max);
  };
  int worst = 0;
  for (int k = 1; k < static_cast<int>(report.modules.size()); ++k) {
    if (badness(k) > badness(worst)) worst = k;
  }
  return worst;
}

Status write_check_plots(const std::filesystem::path& folder, const DisplayCalibration& display,
                         const CalibrationReport& report, std::optional<int> module) {
  const int shown = module.value_or(worst_module(report));
  const auto file_of_module = [&](const char* what) {
    return folder / fmt::format("{}-module-{:03}.svg", what, shown);
  };
  LFD_TRY_STATUS(make_folder(folder));
  LFD_TRY_STATUS(write_file(folder / "overview.svg", plots::overview(display, report)));
  LFD_TRY_STATUS(write_file(folder / "coverage.svg", plots::coverage(display, report)));
  LFD_TRY_STATUS(write_file(file_of_module("warp"), plots::warp(display, shown)));
  LFD_TRY_STATUS(write_file(file_of_module("condition"), plots::condition(display, report, shown)));
  LFD_TRY_STATUS(write_file(file_of_module("round-trip"), plots::round_trip(display, shown)));
  if (std::holds_alternative<GridMap>(display.modules[static_cast<std::size_t>(shown)].map)) {
    LFD_TRY_STATUS(write_file(file_of_module("grid"), plots::grid(display, shown)));
  }
  return {};
}

}  // namespace lfd
