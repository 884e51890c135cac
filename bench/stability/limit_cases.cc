// The map in double near its limits, against 113-bit arithmetic.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/log.h"
#include "bench/stability/groups.h"
#include "bench/stability/quad.h"

namespace lfd::bench {
namespace {

constexpr const char* kGroup = "limits";
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr std::array kShares{1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12};

// Emitter to the left and low, so that nothing is symmetric.
constexpr Emitter kEmitter{-0.3, -0.4, -1.8};
Optics optics_with(Diffuser diffuser) { return {diffuser, 0.1, 3.0, 0, false}; }

constexpr std::array<ScreenPoint, 5> kScreenPoints{{{0, 0}, {0.7, 0.4}, {-0.7, -0.3}, {-0.3, 0.1}, {0.1, -0.44}}};

// The point of the screen point's line at a depth.
Point3<Physical> on_line(const PixelLine& line, double depth, double vz) {
  return line.on_screen + (depth / vz) * (line.on_observer_line - line.on_screen);
}

// Error of the map over what the roundings of its own operations, and of k near the cone's limit, may make of it.
void take_error(Worst& worst, const Optics& optics, const Emitter& e, Point3<Physical> p) {
  const auto got = screen_from_physical(optics, e, p);
  const QuadScreenPoint expected = quad_screen_from_physical(optics, e, p);
  if (!got) {
    worst.take(expected.w > 0 ? std::numeric_limits<double>::infinity() : 0);
    return;
  }
  // w = 1 + k z / vz cancels near the cone's limit: the rounding of k z / vz, which is about 1, is there in it.
  const double loss = optics.diffuser == Diffuser::kConical ? 1 / expected.w : 0;
  const double size = std::abs(expected.x) + std::abs(e.x) + loss * std::abs(expected.x - e.x);
  worst.take(std::abs(got->x - expected.x) / (kEpsilon * size));
  worst.take(std::abs(got->y - expected.y) / (kEpsilon * (std::abs(expected.y) + std::abs(optics.observer_height_m))));
}

// Depth of the limit on the line of a screen point.
using Limit = double (*)(const Optics&, const PixelLine&);
double singular(const Optics&, const PixelLine& line) { return line.singular_depth; }
double observer(const Optics& optics, const PixelLine&) { return optics.observer_distance_m; }

void approach(Worst& worst, const Optics& optics, Limit limit) {
  for (const ScreenPoint s : kScreenPoints) {
    const auto line = line_of_screen_point(optics, kEmitter, s);
    if (!line) continue;
    for (const double share : kShares) {
      const double depth = limit(optics, *line) * (1 - share);
      take_error(worst, optics, kEmitter, on_line(*line, depth, optics.observer_distance_m));
    }
  }
}

std::string image_beyond(const Optics& optics, Limit limit) {
  for (const ScreenPoint s : kScreenPoints) {
    const auto line = line_of_screen_point(optics, kEmitter, s);
    if (!line) return "a screen point has no line";
    for (const double share : kShares) {
      const double depth = limit(optics, *line) * (1 + share);
      const Point3<Physical> p = on_line(*line, depth, optics.observer_distance_m);
      if (screen_from_physical(optics, kEmitter, p)) return fmt::format("an image {:g} beyond the limit", share);
    }
  }
  return "";
}

// Along a line y / z fixed, not a pixel's own: sy grows without bounds toward the observers.
std::string image_on_the_limit(const Optics& optics) {
  const double vz = optics.observer_distance_m;
  for (const double z : {kEmitter.z, vz}) {
    for (const double x : {-0.3, 0.0, 0.4}) {
      if (screen_from_physical(optics, kEmitter, {x, 0.1, z})) return fmt::format("an image at z = {}", z);
      if (screen_from_physical(optics, kEmitter, {x, 0.2, z})) return fmt::format("an image at z = {}", z);
    }
  }
  return "";
}

// Points beside the lines: coordinates that do not shrink as the limit is approached, so that the screen point runs
// away.
void run_away(Worst& worst, const Optics& optics) {
  for (const double share : kShares) {
    for (const double z : {kEmitter.z * (1 - share), optics.observer_distance_m * (1 - share)}) {
      for (const Point3<Physical> p : {Point3<Physical>{0.5, 0.4, z}, {-0.3, 0.1, z}, {-0.3 + 1e-9, 0.1 - 1e-9, z}}) {
        take_error(worst, optics, kEmitter, p);
      }
    }
  }
}

// From the screen to the point of the line and back.
void round_trip(Worst& worst, const Optics& optics) {
  for (const ScreenPoint s : kScreenPoints) {
    const auto line = line_of_screen_point(optics, kEmitter, s);
    if (!line) continue;
    for (const double share : kShares) {
      for (const double depth : {line->singular_depth * (1 - share), optics.observer_distance_m * (1 - share)}) {
        const Point3<Physical> p = on_line(*line, depth, optics.observer_distance_m);
        const auto back = screen_from_physical(optics, kEmitter, p);
        if (!back) {
          worst.take(std::numeric_limits<double>::infinity());
          continue;
        }
        const double w = quad_screen_from_physical(optics, kEmitter, p).w;
        const double fall = 1 - p.z / optics.observer_distance_m;
        // A coordinate is rounded at its own size, of up to 8 m; the map magnifies that by 1 / w and 1 / fall.
        const double allowed = kEpsilon * 8 / std::min({1.0, w, fall});
        worst.take(std::hypot(back->x - s.x, back->y - s.y) / allowed);
      }
    }
  }
}

}  // namespace

void add_limit_cases(StabilityCases& cases) {
  for (const Diffuser diffuser : {Diffuser::kLinear, Diffuser::kConical}) {
    const std::string name = diffuser == Diffuser::kLinear ? "linear" : "conical";
    const Optics optics = optics_with(diffuser);
    const std::string plane = diffuser == Diffuser::kLinear ? "emitter plane" : "z_c";
    const std::string reason = "roundings of the result's own size: no digits are lost (113-bit reference)";
    cases.push_back(bounded(kGroup, fmt::format("{}: {} from the front, 1e-1 to 1e-12", name, plane), 16, reason,
                            [optics](Worst& worst) { approach(worst, optics, singular); }));
    cases.push_back(faultless(kGroup, fmt::format("{}: {} from behind, 1e-1 to 1e-12", name, plane), "no image",
                              [optics] { return image_beyond(optics, singular); }));
    cases.push_back(bounded(kGroup, name + ": observer line from behind, 1e-1 to 1e-12", 16, reason,
                            [optics](Worst& worst) { approach(worst, optics, observer); }));
    cases.push_back(faultless(kGroup, name + ": observer line from the front, 1e-1 to 1e-12", "no image",
                              [optics] { return image_beyond(optics, observer); }));
    cases.push_back(faultless(kGroup, name + ": on the emitter's plane and on the observer line", "no image",
                              [optics] { return image_on_the_limit(optics); }));
    cases.push_back(bounded(kGroup, name + ": beside the lines, screen points run away", 16, reason,
                            [optics](Worst& worst) { run_away(worst, optics); }));
    cases.push_back(bounded(kGroup, name + ": screen to line and back, 1e-1 to 1e-12", 16,
                            "roundings of the point in space, magnified by the map",
                            [optics](Worst& worst) { round_trip(worst, optics); }));
  }
}

}  // namespace lfd::bench
