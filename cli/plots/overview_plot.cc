// A display from above, its angles and its depth budget, side by side.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/log.h"
#include "calibration/curved_screen.h"
#include "cli/plots/axes.h"
#include "cli/plots/check_plots.h"
#include "cli/plots/heat_map.h"

namespace lfd::plots {
namespace {

constexpr const char* kEmitterInk = "#1f5fbf";
constexpr const char* kScreenInk = "#222222";
constexpr const char* kObserverInk = "#2a8c4a";
constexpr const char* kGapInk = "#d62728";

double degrees(double angle_rad) { return angle_rad * 180 / std::numbers::pi; }

// (x, z) in metres.
using Outline = std::vector<glm::dvec2>;

Outline screen_outline(const DisplayCalibration& display) {
  Outline outline;
  for (int i = 0; i <= 64; ++i) {
    const auto p = surface_point(display.optics, {(i / 64.0 - 0.5) * display.screen.width_m, 0});
    outline.push_back({p.x, p.z});
  }
  return outline;
}

// The part of the observers' line, or arc, that the outermost emitters reach through the middle of the screen.
Outline observer_outline(const DisplayCalibration& display) {
  double left = -display.screen.width_m / 2, right = -left;
  for (const ModuleCalibration& module : display.modules) {
    const auto line = line_of_screen_point(display.optics, module.emitter, {0, display.optics.observer_height_m});
    if (!line) continue;
    left = std::min(left, line->on_observer_line.x);
    right = std::max(right, line->on_observer_line.x);
  }
  const double vz = display.optics.observer_distance_m;
  if (!display.optics.observer_arc) return {{left, vz}, {right, vz}};
  Outline outline;
  const double radius = display.optics.screen_radius_m + vz;
  const auto arc_length = [radius](double x) { return radius * std::asin(std::clamp(x / radius, -1.0, 1.0)); };
  const double first = arc_length(left), last = arc_length(right);
  for (int i = 0; i <= 64; ++i) {
    const glm::dvec2 p = CurvedScreen(radius).point_at(first + (last - first) * i / 64.0);
    outline.push_back({p.x, p.y + vz});
  }
  return outline;
}

Outline emitter_places(const DisplayCalibration& display) {
  Outline places;
  for (const ModuleCalibration& module : display.modules) places.push_back({module.emitter.x, module.emitter.z});
  return places;
}

void widen(Range& range, double value) {
  range.from = std::min(range.from, value);
  range.to = std::max(range.to, value);
}

std::vector<Place> placed(const Axes& axes, const Outline& outline) {
  std::vector<Place> places;
  for (const glm::dvec2 p : outline) places.push_back(axes.at(p.x, p.y));
  return places;
}

// From each emitter through the middle of the screen to the observers.
void draw_rays(Svg& svg, const Axes& axes, const DisplayCalibration& display) {
  for (const ModuleCalibration& module : display.modules) {
    const auto line = line_of_screen_point(display.optics, module.emitter, {0, 0});
    if (!line) continue;
    svg.polyline({axes.at(module.emitter.x, module.emitter.z), axes.at(0, 0),
                  axes.at(line->on_observer_line.x, line->on_observer_line.z)},
                 {.stroke = "#c9d8ee", .width_px = 0.6});
  }
}

void draw_emitters(Svg& svg, const Axes& axes, const DisplayCalibration& display, const CalibrationReport& report) {
  const std::size_t count = display.modules.size(), named_every = count <= 12 ? 1 : (count + 7) / 8;
  for (std::size_t k = 0; k < count; ++k) {
    const Place place = axes.at(display.modules[k].emitter.x, display.modules[k].emitter.z);
    svg.circle(place, 2.5, {.fill = kEmitterInk});
    if (k % named_every == 0 || k + 1 == count) {
      svg.text({place.x, place.y + 16}, fmt::format("{}", k), {.size_px = 10, .anchor = Anchor::kMiddle});
    }
  }
  for (const AngularGap& gap : report.angles.gaps) {
    const Emitter &left = display.modules[static_cast<std::size_t>(gap.left_module)].emitter,
                  &right = display.modules[static_cast<std::size_t>(gap.right_module)].emitter;
    svg.line(axes.at(left.x, left.z), axes.at(right.x, right.z), {.stroke = kGapInk, .width_px = 3});
  }
}

void draw_from_above(Svg& svg, const Box& box, const DisplayCalibration& display, const CalibrationReport& report) {
  const Outline screen = screen_outline(display), observers = observer_outline(display),
                emitters = emitter_places(display);
  Range x{0, 0}, z{0, 0};
  for (const Outline* outline : {&screen, &observers, &emitters}) {
    for (const glm::dvec2 p : *outline) {
      widen(x, p.x);
      widen(z, p.y);
    }
  }
  const double margin_x = 0.06 * (x.to - x.from), margin_z = 0.08 * (z.to - z.from);
  x = {x.from - margin_x, x.to + margin_x};
  z = {z.from - margin_z, z.to + margin_z};
  const Axes axes(with_equal_scales(box, x, z), x, z);
  axes.draw_grid(svg);
  draw_rays(svg, axes, display);
  svg.polyline(placed(axes, screen), {.stroke = kScreenInk, .width_px = 4});
  svg.polyline(placed(axes, observers), {.stroke = kObserverInk, .width_px = 2, .dashes = "7 4"});
  draw_emitters(svg, axes, display, report);
  axes.draw(svg, {"From above: viewers are at the top", "x, m", "z, m (0: the screen's middle)"});
}

void draw_keys(Svg& svg, Place at, const DisplayCalibration& display, const CalibrationReport& report) {
  draw_key(svg, at, kEmitterInk, "emitters, with module numbers");
  draw_key(svg, {at.x + 240, at.y}, kScreenInk, display.optics.screen_radius_m == 0 ? "screen" : "screen (curved)");
  draw_key(svg, {at.x, at.y + 20}, kObserverInk, display.optics.observer_arc ? "observers' arc" : "observers' line");
  if (!report.angles.gaps.empty()) {
    draw_key(svg, {at.x + 240, at.y + 20}, kGapInk, "gap: over 2 x the median angle");
  }
}

// Between neighbours: the angle of their middle, and the angle between them, in degrees.
std::vector<Place> spacings(const DisplayCalibration& display, double s) {
  const auto directions = emitter_directions(display, {s, 0});
  std::vector<Place> points;
  for (std::size_t i = 1; i < directions.size(); ++i) {
    const double left = degrees(directions[i - 1].angle_rad), right = degrees(directions[i].angle_rad);
    points.push_back({(left + right) / 2, right - left});
  }
  return points;
}

void draw_spacing(Svg& svg, const Box& box, const DisplayCalibration& display, const AngularReport& angles) {
  struct Series {
    const char* name;
    const char* colour;
    std::vector<Place> points;
  };
  const double border = display.screen.width_m / 2;
  const Series series[] = {{"from the left border", "#e08214", spacings(display, -border)},
                           {"from the right border", "#8c4ab0", spacings(display, border)},
                           {"from the centre", "#1f5fbf", spacings(display, 0)}};
  Range direction{0, 0}, spacing{0, 0};
  for (const Series& one : series) {
    for (const Place p : one.points) {
      widen(direction, p.x);
      widen(spacing, 1.12 * p.y);
    }
  }
  direction = {direction.from - 1, direction.to + 1};
  if (!(spacing.to > 0)) spacing.to = 1;
  const Axes axes(box, direction, spacing);
  axes.draw_grid(svg);
  for (const Series& one : series) {
    std::vector<Place> places;
    for (const Place p : one.points) places.push_back(axes.at(p.x, p.y));
    svg.polyline(places, {.stroke = one.colour, .width_px = 1});
    for (const Place p : places) svg.circle(p, 2.2, {.fill = one.colour});
  }
  if (angles.from_centre) {
    const double median = degrees(angles.from_centre->median_rad);
    svg.line(axes.at(direction.from, median), axes.at(direction.to, median), {.stroke = "#1f5fbf", .dashes = "5 4"});
  }
  for (int i = 0; i < 3; ++i) {
    draw_key(svg, {box.x + 170 * i - 20, box.y + box.height + 48}, series[i].colour, series[i].name);
  }
  axes.draw(svg, {"Angles between neighbouring emitters (dashed: median from the centre)",
                  "direction of the emitters, degrees", "spacing, degrees"});
}

void draw_depth(Svg& svg, const Box& box, const DepthBudget& depth) {
  const double furthest = depth.spots.back().distance_m;
  const Range distance{0, furthest}, spot{0, 1.1e3 * depth.spot_m(furthest)};
  const Axes axes(box, distance, spot);
  axes.draw_grid(svg);
  svg.line(axes.at(0, 1e3 * depth.spot_m(0)), axes.at(furthest, 1e3 * depth.spot_m(furthest)),
           {.stroke = "#1f5fbf", .width_px = 2});
  if (depth.doubled_at_m <= furthest) {
    const Place doubled = axes.at(depth.doubled_at_m, 2e3 * depth.spot_on_screen_m);
    svg.circle(doubled, 4, {.fill = kGapInk});
    svg.text({doubled.x + 10, doubled.y + 14},
             fmt::format("doubled: {:.3g} mm at {:.3g} m", 2e3 * depth.spot_on_screen_m, depth.doubled_at_m), {});
  }
  axes.draw(svg, {fmt::format("Depth budget: the spot is {:.3g} mm on the screen", 1e3 * depth.spot_on_screen_m),
                  "distance from the screen, m", "spot, mm"});
}

}  // namespace

std::string overview(const DisplayCalibration& display, const CalibrationReport& report) {
  Svg svg(1180, 760);
  svg.text({590, 30},
           fmt::format("{}: {} modules of {} x {} px, screen {:.4g} x {:.4g} m, {} diffuser", display.name,
                       display.modules.size(), display.image.width, display.image.height, display.screen.width_m,
                       display.screen.height_m, display.optics.diffuser == Diffuser::kLinear ? "linear" : "conical"),
           {.size_px = 16, .anchor = Anchor::kMiddle, .is_bold = true});
  draw_from_above(svg, {80, 80, 460, 560}, display, report);
  draw_keys(svg, {80, 700}, display, report);
  draw_spacing(svg, {660, 80, 470, 220}, display, report.angles);
  if (report.depth) draw_depth(svg, {660, 430, 470, 250}, *report.depth);
  return svg.finish();
}

}  // namespace lfd::plots
