// Angles between neighbours, sorted from left to right.
#include "calibration/check/angles.h"

#include <algorithm>
#include <cmath>

#include "calibration/make.h"

namespace lfd {
namespace {

constexpr double kOneDirection_rad = 1e-9;
constexpr double kGap = 2;  // times the median

std::optional<AngularSpacing> spacing_of(const std::vector<EmitterDirection>& directions) {
  if (directions.size() < 2) return std::nullopt;
  std::vector<double> angles;
  for (std::size_t i = 1; i < directions.size(); ++i) {
    angles.push_back(directions[i].angle_rad - directions[i - 1].angle_rad);
  }
  std::ranges::sort(angles);
  return AngularSpacing{angles.front(), angles[(angles.size() - 1) / 2], angles.back()};
}

std::vector<AngularGap> gaps_between(const std::vector<EmitterDirection>& directions, double median_rad) {
  std::vector<AngularGap> gaps;
  for (std::size_t i = 1; i < directions.size(); ++i) {
    const double angle = directions[i].angle_rad - directions[i - 1].angle_rad;
    if (angle > kGap * median_rad) gaps.push_back({directions[i - 1].module, directions[i].module, angle});
  }
  return gaps;
}

ModuleOrder order_of(const DisplayCalibration& display) {
  const auto x = [](const ModuleCalibration& module) { return module.emitter.x; };
  if (std::ranges::is_sorted(display.modules, std::ranges::less(), x)) return ModuleOrder::kLeftToRight;
  if (std::ranges::is_sorted(display.modules, std::ranges::greater(), x)) return ModuleOrder::kRightToLeft;
  return ModuleOrder::kMixed;
}

}  // namespace

std::vector<EmitterDirection> emitter_directions(const DisplayCalibration& display, ScreenPoint s) {
  const Point3<Physical> seen_from = surface_point(display.optics, s);
  std::vector<EmitterDirection> directions;
  for (std::size_t k = 0; k < display.modules.size(); ++k) {
    const Emitter& emitter = display.modules[k].emitter;
    const double right = emitter.x - seen_from.x, behind = seen_from.z - emitter.z;
    const double angle_rad = display.optics.diffuser == Diffuser::kConical
                                 ? right / std::hypot(seen_from.y - emitter.y, behind)
                                 : std::atan2(right, behind);
    directions.push_back({static_cast<int>(k), angle_rad});
  }
  std::ranges::stable_sort(directions, {}, &EmitterDirection::angle_rad);
  const auto is_same = [](const EmitterDirection& a, const EmitterDirection& b) {
    return b.angle_rad - a.angle_rad < kOneDirection_rad;
  };
  directions.erase(std::unique(directions.begin(), directions.end(), is_same), directions.end());
  return directions;
}

AngularReport check_angles(const DisplayCalibration& display) {
  const double border = display.screen.width_m / 2;
  const std::vector<EmitterDirection> directions = emitter_directions(display, {0, 0});
  AngularReport report;
  report.from_centre = spacing_of(directions);
  report.from_left = spacing_of(emitter_directions(display, {-border, 0}));
  report.from_right = spacing_of(emitter_directions(display, {border, 0}));
  report.order = order_of(display);
  report.scattering_rad = display.angular_scattering_rad;
  for (const auto& spacing : {report.from_centre, report.from_left, report.from_right}) {
    if (!spacing) continue;
    const double gap = spacing->max_rad / display.angular_scattering_rad;
    report.gap_over_scattering = std::max(gap, report.gap_over_scattering.value_or(0));
  }
  if (!report.from_centre) return report;
  report.gaps = gaps_between(directions, report.from_centre->median_rad);
  std::vector<ModuleCalibration> row;
  for (const EmitterDirection& direction : directions) {
    row.push_back(display.modules[static_cast<std::size_t>(direction.module)]);
  }
  const double rule_rad = scattering_by_rule_rad(row);
  if (rule_rad > 0) report.scattering_over_rule = display.angular_scattering_rad / rule_rad;
  return report;
}

}  // namespace lfd
