// Numbers against limits.
#include "calibration/check/acceptance.h"

#include "base/log.h"

namespace lfd {

std::vector<std::string> missed_limits(const CalibrationReport& report, const AcceptanceLimits& limits) {
  std::vector<std::string> missed;
  const auto at_most = [&](const char* what, double MapNumbers::*field, double limit) {
    const int module = report.worst_by(field);
    const double value = report.modules[static_cast<std::size_t>(module)].*field;
    if (value <= limit) return;
    missed.push_back(fmt::format("{}: {:.4g} (module {}); at most {:.4g} is accepted", what, value, module, limit));
  };
  at_most("round trip, px", &MapNumbers::round_trip_max_px, limits.round_trip_max_px);
  at_most("mirrored share of the image", &MapNumbers::mirrored, limits.mirrored);
  at_most("near singular share of the image", &MapNumbers::near_singular, limits.near_singular);
  at_most("folded share of the grid", &MapNumbers::folded, limits.folded);
  at_most("share of the image without a map", &MapNumbers::image_unmapped, limits.image_unmapped);
  at_most("share of the grid in holes", &MapNumbers::incomplete, limits.incomplete);
  at_most("condition number", &MapNumbers::condition_max, limits.condition_max);
  const int darkest = report.least_covering();
  const double coverage = report.modules[static_cast<std::size_t>(darkest)].coverage;
  if (coverage < limits.coverage_least) {
    missed.push_back(fmt::format("coverage: {:.4g} of the screen (module {}); at least {:.4g} is accepted", coverage,
                                 darkest, limits.coverage_least));
  }
  if (const double gap = report.angles.gap_over_scattering.value_or(0); gap > limits.gap_over_scattering) {
    missed.push_back(
        fmt::format("angle between neighbouring emitters: {:.4g} x the angular scattering; at most {:.4g} is accepted",
                    gap, limits.gap_over_scattering));
  }
  if (const double depth = report.depth ? report.depth->doubled_at_m : 0; depth < limits.depth_least_m) {
    missed.push_back(fmt::format("depth: the spot has doubled {:.4g} m from the screen; at least {:.4g} m is accepted",
                                 depth, limits.depth_least_m));
  }
  return missed;
}

Status accept_calibration(const DisplayCalibration& display) {
  const auto report = check_calibration(display, default_half_depth_m(display), kQuickSampling);
  const std::vector<std::string> missed = missed_limits(report, {});
  if (missed.empty()) return {};
  return Error(fmt::format("calibration refused: {}", fmt::join(missed, "; ")));
}

}  // namespace lfd
